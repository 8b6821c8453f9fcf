#include "fit/fit.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <chrono>
#include <cmath>
#include <utility>

#include "fit/diagnosis.hpp"
#include "fit/emulation.hpp"
#include "fit/inference.hpp"
#include "fit/multistart.hpp"
#include "fit/objective.hpp"
#include "fit/prior_json.hpp"
#include "fit/problem.hpp"
#include "fit/runs_test.hpp"
#include "model/emulator_cache.hpp"

namespace skinfit {
namespace {

/// The minima that one solver finds, and how long it took.
struct Search {
    std::vector<DistinctMinimum> minima;
    double seconds;
};

Search search(const Objective& cheap, const Objective& objective, Solver solver, std::uint64_t count,
              const SearchLimits& limits = {}) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<DistinctMinimum> minima = distinct_minima(cheap, objective, solver, count, limits);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    return {.minima = std::move(minima), .seconds = elapsed.count()};
}

/// Of each other solver, from the configured start. The angular solver takes so long that methods without derivatives
/// are stopped after a few seconds' worth of evaluations; their answers stand as they are.
std::vector<SolverAnswer> other_answers(const Objective& cheap, const Objective& objective,
                                        const Configuration& configuration) {
    SearchLimits limits;
    if (configuration.engine == Engine::solver) limits = {.cheap_evaluations = 600, .evaluations = 60};
    std::vector<SolverAnswer> answers;
    for (std::size_t i = 0; i < solver_count; ++i) {
        const auto solver = static_cast<Solver>(i);
        if (solver == configuration.solver) continue;
        Search other = search(cheap, objective, solver, 1, limits);
        answers.push_back(
            {.solver = solver, .minimum = std::move(other.minima.front().minimum), .seconds = other.seconds});
    }
    return answers;
}

std::vector<std::string> priors_in_words(const FitProblem& problem) {
    std::vector<std::string> words;
    for (const FreeParameter& free : problem.free) {
        if (free.prior) words.push_back(fmt::format("{}: {}", info(free.parameter).name, in_words(*free.prior)));
    }
    for (const DerivedPrior& derived : problem.derived_priors) {
        words.push_back(fmt::format("{}: {}", derived_table()[static_cast<std::size_t>(derived.quantity)].name,
                                    in_words(derived.prior)));
    }
    return words;
}

/// `FitResult::degrees_of_freedom`: the trace of one minus the matrix that maps the data to the fitted data.
double degrees_of_freedom(const Objective& objective, const Minimum& minimum) {
    const auto wavelengths = static_cast<Eigen::Index>(objective.wavelength_count());
    const auto free = static_cast<Eigen::Index>(objective.free_count());
    if (objective.residual_count() == objective.wavelength_count()) return static_cast<double>(wavelengths - free);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(objective.misfit(minimum.values).jacobian);
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), free);
    return static_cast<double>(wavelengths) - q.topRows(wavelengths).squaredNorm();
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
        row.bounds = problem.free[i].bounds;
        row.uncertainty = uncertainty.parameters[i];
    }
    return fitted;
}

double root_mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

std::optional<double> chi2_p_value(double chi2, double degrees_of_freedom) {
    if (!(degrees_of_freedom > 0.0)) return std::nullopt;
    const boost::math::chi_squared_distribution<double> law(degrees_of_freedom);
    return boost::math::cdf(boost::math::complement(law, chi2));
}

}  // namespace

ForwardModel make_model(const FitProblem& problem, Engine engine, const EnsembleCache& cache) {
    if (engine == Engine::solver) return angular_solver(problem.experiment);
    if (engine == Engine::emulator) return cached_emulator(emulator_domain(problem), cache);
    return cached_ensemble(problem.experiment.sample(), true_wavelengths_nm(problem.experiment, problem.wavelength_nm),
                           problem.walk, cache);
}

ForwardModel cheap_model(const FitProblem& problem, const ForwardModel& model) {
    constexpr std::uint64_t few_rays = 3000;
    if (const auto* const ensemble = std::get_if<PathEnsemble>(&model)) return ensemble->with_about(few_rays);
    if (std::holds_alternative<Emulator>(model)) return model;
    return angular_solver(problem.experiment, AngularResolution::for_accuracy(1e-3));
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

bool has_own_cost(const FitResult& result) {
    return !result.priors.empty() || result.configuration.loss != Loss::squares ||
           !result.configuration.weights.empty();
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
    const Objective cheap(problem, cheap_model(problem, model));
    Search found = search(cheap, objective, complete.solver, complete.starts);
    const Inference inference = infer(objective, found.minima.front().minimum, complete.uncertainty, complete.seed);
    const Minimum& minimum = inference.minimum;
    const Objective::Modelled modelled = objective.model(minimum.values);

    FitResult result;
    result.spectrum_name = spectrum.name;
    result.spectrum_source = spectrum.source;
    result.unit_rule = spectrum.unit_rule;
    result.sigma_source = problem.sigma_source;
    result.findings = options.findings;
    result.wavelength_nm = problem.wavelength_nm;
    result.measured = problem.measured;
    result.sigma = problem.sigma;
    result.modelled.assign(modelled.reading.begin(), modelled.reading.end());
    result.rmse = root_mean_square(result.modelled, result.measured);
    result.chi2 = minimum.chi2;
    result.cost = minimum.cost;
    result.degrees_of_freedom = degrees_of_freedom(objective, minimum);
    result.p_value = chi2_p_value(result.chi2, result.degrees_of_freedom);
    const Eigen::VectorXd residuals = objective.unexplained(modelled.reading);
    result.runs_p_value = runs_p_value({residuals.data(), static_cast<std::size_t>(residuals.size())});
    result.unexplained = std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
    result.median_sigma = median(problem.sigma);
    if (const auto* const emulator = std::get_if<Emulator>(&model)) {
        result.emulator_error = emulator->certified_error();
    } else {
        result.monte_carlo_error = median({modelled.standard_error.begin(), modelled.standard_error.end()});
    }
    result.parameters = fitted_parameters(problem, minimum, inference.uncertainty, complete);
    result.free = free_parameters(complete);
    result.correlation = inference.uncertainty.correlation;
    result.identifiability = inference.identifiability;
    result.profile = inference.profile;
    result.posterior = inference.posterior;
    if (result.degrees_of_freedom > 0) result.inflation = std::sqrt(result.chi2 / result.degrees_of_freedom);
    result.priors = priors_in_words(problem);
    result.answer = {.solver = complete.solver, .minimum = minimum, .seconds = found.seconds};
    if (options.cross_check) result.cross_check = other_answers(cheap, objective, complete);
    if (inference.profile && inference.profile->better_minimum) found.minima.push_back({.minimum = minimum});
    result.minima = distinct(objective, std::move(found.minima));
    result.configuration = complete;
    const Diagnosis diagnosis = diagnose(result);
    result.verdict = diagnosis.verdict;
    result.reasons = diagnosis.reasons;
    return result;
}

}  // namespace skinfit
