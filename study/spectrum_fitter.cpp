#include "study/spectrum_fitter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include "core/input_error.hpp"
#include "fit/fit.hpp"
#include "fit/inspection.hpp"
#include "fit/model_split.hpp"
#include "fit/report.hpp"
#include "fit/tissue.hpp"

namespace skinfit {
namespace {

/// The first warning that is not accepted.
const Finding* rejecting(const std::vector<Finding>& findings, const std::vector<std::string>& accepted) {
    const auto found = std::ranges::find_if(findings, [&](const Finding& each) {
        return each.severity == Severity::warning && std::ranges::find(accepted, each.name) == accepted.end();
    });
    return found == findings.end() ? nullptr : &*found;
}

/// Of the marginal distribution, at 0, 1, ..., 100 %.
std::vector<double> quantiles_of(const Eigen::RowVectorXd& draws) {
    constexpr std::size_t parts = 100;
    std::vector<double> sorted(draws.begin(), draws.end());
    std::ranges::sort(sorted);
    std::vector<double> quantiles;
    for (std::size_t k = 0; k <= parts; ++k) quantiles.push_back(sorted[k * (sorted.size() - 1) / parts]);
    return quantiles;
}

StudiedSpectrum described(const FitResult& result) {
    StudiedSpectrum studied;
    studied.verdict = name_of(result.verdict);
    if (result.verdict == Verdict::consistent) studied.status = FitStatus::fitted;
    if (result.verdict == Verdict::suspect) studied.status = FitStatus::suspect;
    if (result.verdict == Verdict::failed) studied.status = FitStatus::failed;
    for (const std::string& reason : result.reasons) studied.reason += (studied.reason.empty() ? "" : " | ") + reason;
    const std::vector<ModelSplit> splits = model_splits(result);
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const FittedParameter& free = result.free[i];
        const auto row = static_cast<Eigen::Index>(i);
        studied.parameters.push_back({.name = free.name,
                                      .value = free.value,
                                      .sigma = free.uncertainty.sigma,
                                      .interval_95 = free.uncertainty.interval_95,
                                      .bounds = free.bounds,
                                      .status = free.uncertainty.status,
                                      .prior = free.prior,
                                      .decided_by_prior = free.uncertainty.decided_by_prior,
                                      .split_by_model = is_split_by_model(splits, free.name)});
        if (result.posterior) studied.parameters.back().quantiles = quantiles_of(result.posterior->draws.row(row));
        for (Eigen::Index column = 0; column < row; ++column) {
            studied.correlation.push_back(result.correlation(row, column));
        }
    }
    for (const TissueEstimate& each : tissue_estimates(result)) {
        studied.tissue.push_back({.name = std::string(each.quantity->name),
                                  .value = each.value,
                                  .interval_95 = each.interval_95,
                                  .quantiles = {}});
        if (result.posterior) studied.tissue.back().quantiles = quantiles_of(each.draws);
    }
    studied.rmse = result.rmse;
    studied.chi2 = result.chi2;
    studied.degrees_of_freedom = result.degrees_of_freedom;
    studied.p_value = result.p_value;
    return studied;
}

}  // namespace

SpectrumFitter::SpectrumFitter(const Study& study, const DiskCache& cache)
    : study_(&study), cache_(cache), shelf_(cache) {}

StudiedSpectrum SpectrumFitter::fit_it(const Spectrum& spectrum) {
    const FitInput input = fit_input(study_->configuration, {&spectrum, 1});
    const std::vector<Finding> findings = findings_before_fit(input);
    if (const Finding* const finding = rejecting(findings, study_->accept)) {
        return {.status = FitStatus::rejected, .reason = fmt::format("{}: {}", finding->name, finding->message)};
    }
    const FitResult result = fit_spectra(
        input, {.cache = cache_, .findings = findings, .models = [this](const auto& problem, Engine engine) {
                    return shelf_.models(problem, engine);
                }});
    StudiedSpectrum studied = described(result);
    studied.indices = indices_of(spectrum, input.parts.front().configuration.noise);
    return studied;
}

StudiedSpectrum SpectrumFitter::fit(const Spectrum& spectrum) {
    const auto begin = std::chrono::steady_clock::now();
    StudiedSpectrum studied;
    try {
        studied = fit_it(spectrum);
    } catch (const InputError& error) {
        studied = {.status = FitStatus::failed, .reason = error.what()};
    } catch (const std::exception& error) {
        studied = {.status = FitStatus::failed, .reason = fmt::format("internal error: {}", error.what())};
    }
    studied.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return studied;
}

}  // namespace skinfit
