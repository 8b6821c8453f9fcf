#include "study/pixel_fitter.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "core/input_error.hpp"
#include "fit/configuration_check.hpp"
#include "fit/diagnosis.hpp"
#include "fit/inspection.hpp"
#include "fit/models.hpp"
#include "measurements/quality_checks.hpp"

namespace skinfit {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Configuration for_pixels(Configuration configuration) {
    if (configuration.uncertainty != UncertaintyMethod::covariance) {
        throw InputError({.where = "uncertainty",
                          .problem = "must be covariance for the pixels of a cube",
                          .why = "profiles and chains take seconds a spectrum, and a cube has very many",
                          .remedy = "leave it out, and fit the mean of a region with it"});
    }
    configuration.engine = Engine::emulator;
    return configuration;
}

FitProblem problem_of(const Configuration& configuration, Spectrum common) {
    // Stands for what is measured until there is a pixel; a constant is refused.
    common.value.clear();
    for (std::size_t i = 0; i < common.wavelength_nm.size(); ++i) common.value.push_back(i % 2 == 0 ? 0.25 : 0.5);
    check_freedom(configuration, "free");
    return make_problem(configuration, common);
}

std::vector<std::size_t> places(const std::vector<double>& fitted_nm, const std::vector<double>& all_nm) {
    std::vector<std::size_t> found;
    for (const double wavelength_nm : fitted_nm) {
        found.push_back(static_cast<std::size_t>(std::ranges::find(all_nm, wavelength_nm) - all_nm.begin()));
    }
    return found;
}

std::optional<double> improbable_chi2(const FitProblem& problem) {
    const auto freedom =
        static_cast<double>(problem.only().wavelength_nm.size()) - static_cast<double>(problem.free.size());
    if (!(freedom > 0.0)) return std::nullopt;
    const boost::math::chi_squared_distribution<double> law(freedom);
    return boost::math::quantile(boost::math::complement(law, improbable));
}

BulkFitter fitter_of(const FitProblem& problem, const DiskCache& cache) {
    for (const FreeParameter& free : problem.free) {
        if (!info(free.parameter).steers) continue;
        throw InputError({.where = fmt::format("free parameter {}", info(free.parameter).name),
                          .problem = "cannot be adjusted in images",
                          .why = "their fits use the emulator of one geometry",
                          .remedy = fmt::format("fix it (\"free\": [\"-{}\"])", info(free.parameter).name)});
    }
    const std::vector<ForwardModel> models = make_models(problem, Engine::emulator, cache);
    return {problem, std::get<Emulator>(models.front()), pixel_options};
}

/// Every check of a spectrum by itself can reject a pixel under its own name, but for those of repeats, of
/// uncertainties and of the reader's remarks, of which pixels have none, and of repeated wavelengths, which are the
/// whole cube's.
static_assert(std::ranges::all_of(spectrum_checks, [](const SpectrumCheck& each) {
    return (std::ranges::find(pixel_reason_names, each.name) == pixel_reason_names.end()) ==
           (each.name == "noise_against_repeats" || each.name == "doubtful_file" || each.name == "as_read" ||
            each.name == "unusable_uncertainty" || each.name == "repeated_wavelengths");
}));

PixelReason reason_named(const std::string& finding) {
    const auto* const found = std::ranges::find(pixel_reason_names, finding);
    assert(found != pixel_reason_names.end());
    return static_cast<PixelReason>(found - pixel_reason_names.begin());
}

PixelFit without_numbers(FitStatus status, PixelReason reason, std::size_t free_count) {
    return {.status = status,
            .reason = reason,
            .values = std::vector<double>(free_count, none),
            .sigmas = std::vector<double>(free_count, none),
            .rmse = none,
            .chi2 = none};
}

}  // namespace

PixelFitter::PixelFitter(const Configuration& configuration, const Spectrum& common, const DiskCache& cache)
    : common_(common),
      problem_(problem_of(for_pixels(configuration), common)),
      fitted_(places(problem_.only().wavelength_nm, common.wavelength_nm)),
      improbable_chi2_(improbable_chi2(problem_)),
      fitter_(fitter_of(problem_, cache)) {}

PixelReason PixelFitter::reason_to_reject(std::span<const double> values) const {
    const auto is_missing = [&](std::size_t place) { return std::isnan(values[place]); };
    if (std::ranges::any_of(fitted_, is_missing)) return PixelReason::missing_values;
    Spectrum spectrum = common_;
    spectrum.wavelength_nm.clear();
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isnan(values[i])) {
            spectrum.missing_nm.push_back(common_.wavelength_nm[i]);
            continue;
        }
        spectrum.wavelength_nm.push_back(common_.wavelength_nm[i]);
        spectrum.value.push_back(values[i]);
    }
    for (const Finding& finding : findings_before_fit(problem_.only().configuration, spectrum)) {
        if (finding.severity == Severity::warning) return reason_named(finding.name);
    }
    return PixelReason::none;
}

PixelReason PixelFitter::reason_to_doubt(const BulkFit& fit) const {
    const auto has = [&](Status status) { return std::ranges::find(fit.statuses, status) != fit.statuses.end(); };
    if (improbable_chi2_ && fit.chi2 > *improbable_chi2_) return PixelReason::misfit;
    if (!improbable_chi2_) return PixelReason::no_freedom;
    if (has(Status::at_lower_bound) || has(Status::at_upper_bound)) return PixelReason::at_bound;
    if (has(Status::not_identifiable)) return PixelReason::not_identifiable;
    return PixelReason::none;
}

PixelFit PixelFitter::fit(std::span<const double> values) const {
    assert(values.size() == common_.wavelength_nm.size());
    const std::size_t free_count = problem_.free.size();
    const PixelReason rejected = reason_to_reject(values);
    if (rejected != PixelReason::none) return without_numbers(FitStatus::rejected, rejected, free_count);
    Eigen::VectorXd measured(static_cast<Eigen::Index>(fitted_.size()));
    for (Eigen::Index i = 0; i < measured.size(); ++i) measured[i] = values[fitted_[static_cast<std::size_t>(i)]];
    BulkFit fit = fitter_.fit(measured);
    if (!fit.converged) return without_numbers(FitStatus::failed, PixelReason::not_converged, free_count);
    const PixelReason doubt = reason_to_doubt(fit);
    std::vector<double> sigmas(free_count, none);
    for (std::size_t i = 0; i < free_count; ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        if (fit.statuses[i] == Status::free) sigmas[i] = std::sqrt(fit.covariance(column, column));
    }
    return {.status = doubt == PixelReason::none ? FitStatus::fitted : FitStatus::suspect,
            .reason = doubt,
            .values = std::move(fit.values),
            .sigmas = std::move(sigmas),
            .rmse = fit.rmse,
            .chi2 = fit.chi2};
}

}  // namespace skinfit
