#include "fit/fit.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "fit/diagnosis.hpp"
#include "fit/inference.hpp"
#include "fit/objective.hpp"
#include "fit/problem.hpp"

namespace skinfit {
namespace {

Minimum minimise(const Objective& objective, Solver solver, std::span<const double> start) {
    return solver == Solver::ceres ? minimise_by_ceres(objective, start) : minimise_by_bobyqa(objective, start);
}

/// Where to start: with an ensemble at the minimum over a small part of it, which is most of the way for little of the
/// cost; else at the problem's starts.
std::vector<double> approach(const FitProblem& problem, const ForwardModel& model, Solver solver) {
    constexpr std::uint64_t few_rays = 3000;
    const auto* const ensemble = std::get_if<PathEnsemble>(&model);
    if (ensemble == nullptr || solver != Solver::ceres) return starts(problem);
    return minimise_by_ceres(Objective(problem, ensemble->with_about(few_rays)), starts(problem)).values;
}

std::vector<FittedParameter> fitted_parameters(const FitProblem& problem, const Minimum& minimum,
                                               const Uncertainty& uncertainty, const Configuration& configuration) {
    std::vector<FittedParameter> fitted;
    for (const ParameterInfo& info : parameter_table()) {
        const double value = value_of(configuration.values, info.parameter);
        fitted.push_back({.parameter = info.parameter,
                          .value = value,
                          .start = value,
                          .bounds = configuration.bounds[static_cast<std::size_t>(info.parameter)],
                          .uncertainty = {.status = Status::fixed,
                                          .sigma = std::nullopt,
                                          .monte_carlo_sigma = std::nullopt,
                                          .interval_95 = {value, value}}});
    }
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        FittedParameter& row = fitted[static_cast<std::size_t>(problem.free[i].parameter)];
        row.value = minimum.values[i];
        row.uncertainty = uncertainty.parameters[i];
    }
    return fitted;
}

double root_mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

std::optional<double> chi2_p_value(double chi2, std::size_t degrees_of_freedom) {
    if (degrees_of_freedom == 0) return std::nullopt;
    const boost::math::chi_squared_distribution<double> law(static_cast<double>(degrees_of_freedom));
    return boost::math::cdf(boost::math::complement(law, chi2));
}

}  // namespace

ForwardModel make_model(const FitProblem& problem, Engine engine, const EnsembleCache& cache) {
    const Sample sample = problem.experiment.sample();
    if (engine == Engine::solver) return AngularSolver(sample, {.incidence_rad = problem.walk.incidence_rad});
    return cached_ensemble(sample, true_wavelengths_nm(problem.experiment, problem.wavelength_nm), problem.walk, cache);
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

std::optional<double> largest_difference_in_sigmas(const FitResult& result, const Minimum& other) {
    std::optional<double> largest;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const FittedParameter& fitted = result.parameters[static_cast<std::size_t>(result.free[i])];
        if (!fitted.uncertainty.sigma) continue;
        const double difference = std::abs(other.values[i] - fitted.value) / *fitted.uncertainty.sigma;
        largest = std::max(largest.value_or(0.0), difference);
    }
    return largest;
}

FitResult fit_spectrum(const Configuration& configuration, const Spectrum& spectrum, const FitOptions& options) {
    const Configuration complete = resolved(configuration, spectrum);
    const FitProblem problem = make_problem(complete, spectrum);
    const ForwardModel model = make_model(problem, complete.engine, options.cache);
    const Objective objective(problem, model);
    const Inference inference =
        infer(objective, minimise(objective, complete.solver, approach(problem, model, complete.solver)),
              complete.uncertainty, complete.seed);
    const Minimum& minimum = inference.minimum;
    const Objective::Modelled modelled = objective.model(minimum.values);

    FitResult result;
    result.spectrum_name = spectrum.name;
    result.spectrum_source = spectrum.source;
    result.unit_rule = spectrum.unit_rule;
    result.sigma_source = problem.sigma_source;
    result.wavelength_nm = problem.wavelength_nm;
    result.measured = problem.measured;
    result.sigma = problem.sigma;
    result.modelled.assign(modelled.reading.begin(), modelled.reading.end());
    result.rmse = root_mean_square(result.modelled, result.measured);
    result.chi2 = minimum.chi2;
    result.degrees_of_freedom = problem.wavelength_nm.size() - problem.free.size();
    result.p_value = chi2_p_value(result.chi2, result.degrees_of_freedom);
    result.median_sigma = median(problem.sigma);
    result.monte_carlo_error = median({modelled.standard_error.begin(), modelled.standard_error.end()});
    result.parameters = fitted_parameters(problem, minimum, inference.uncertainty, complete);
    result.free = free_parameters(complete);
    result.correlation = inference.uncertainty.correlation;
    result.identifiability = inference.identifiability;
    result.profile = inference.profile;
    result.posterior = inference.posterior;
    if (result.degrees_of_freedom > 0) {
        result.inflation = std::sqrt(result.chi2 / static_cast<double>(result.degrees_of_freedom));
    }
    result.answer = {.solver = complete.solver, .minimum = minimum};
    if (options.cross_check) {
        const Solver other = complete.solver == Solver::ceres ? Solver::bobyqa : Solver::ceres;
        result.cross_check.push_back({.solver = other, .minimum = minimise(objective, other, starts(problem))});
    }
    result.configuration = complete;
    const Diagnosis diagnosis = diagnose(result);
    result.verdict = diagnosis.verdict;
    result.reasons = diagnosis.reasons;
    return result;
}

}  // namespace skinfit
