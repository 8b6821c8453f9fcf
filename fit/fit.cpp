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
        if (free.prior) words.push_back(fmt::format("{}: {}", name_of(free), in_words(*free.prior)));
    }
    for (const DerivedPrior& derived : problem.derived_priors) {
        // Of spectra with parameters of their own each has it, in the same words.
        if (derived.measurement > 0) continue;
        words.push_back(fmt::format("{}: {}", derived_table()[static_cast<std::size_t>(derived.quantity)].name,
                                    in_words(derived.prior)));
    }
    return words;
}

/// `FitResult::degrees_of_freedom`: the trace of one minus the matrix that maps the data to the fitted data.
double degrees_of_freedom(const Objective& objective, const Minimum& minimum) {
    const auto readings = static_cast<Eigen::Index>(objective.reading_count());
    const auto free = static_cast<Eigen::Index>(objective.free_count());
    if (objective.residual_count() == objective.reading_count()) return static_cast<double>(readings - free);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(objective.misfit(minimum.values).jacobian);
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), free);
    return static_cast<double>(readings) - q.topRows(readings).squaredNorm();
}

std::vector<FittedParameter> free_rows(const FitProblem& problem, const Minimum& minimum,
                                       const Uncertainty& uncertainty, const Configuration& configuration) {
    std::vector<FittedParameter> rows;
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const FreeParameter& free = problem.free[i];
        rows.push_back({.parameter = free.parameter,
                        .name = name_of(free),
                        .value = minimum.values[i],
                        .start = value_of(configuration.values, free.parameter),
                        .bounds = free.bounds,
                        .uncertainty = uncertainty.parameters[i]});
    }
    return rows;
}

std::vector<FittedParameter> fixed_rows(const Configuration& configuration) {
    std::vector<FittedParameter> rows;
    for (const ParameterInfo& info : parameter_table()) {
        const auto place = static_cast<std::size_t>(info.parameter);
        if (configuration.free[place]) continue;
        const double value = value_of(configuration.values, info.parameter);
        rows.push_back({.parameter = info.parameter,
                        .name = std::string(info.name),
                        .value = value,
                        .start = value,
                        .bounds = configuration.bounds[place],
                        .uncertainty = {.status = Status::fixed,
                                        .sigma = std::nullopt,
                                        .monte_carlo_sigma = std::nullopt,
                                        .interval_95 = {value, value}}});
    }
    return rows;
}

double mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

/// Of all measurements, in their order; readings and residuals are those of the whole problem.
std::vector<FittedSpectrum> fitted_spectra(const FitProblem& problem, const Configuration& configuration,
                                           std::span<const Spectrum> spectra, const Eigen::VectorXd& readings,
                                           const Eigen::VectorXd& residuals) {
    std::vector<FittedSpectrum> fitted;
    Eigen::Index first = 0;
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        const Measurement& measurement = problem.measurements[k];
        const auto count = static_cast<Eigen::Index>(measurement.measured.size());
        const Eigen::VectorXd modelled = readings.segment(first, count);
        FittedSpectrum row{.name = spectra[k].name,
                           .source = spectra[k].source,
                           .unit_rule = spectra[k].unit_rule,
                           .sigma_source = measurement.sigma_source,
                           .configuration = resolved(configuration, spectra[k]),
                           .chi2 = residuals.segment(first, count).squaredNorm(),
                           .wavelength_nm = measurement.wavelength_nm,
                           .measured = measurement.measured,
                           .sigma = measurement.sigma,
                           .modelled = {modelled.begin(), modelled.end()}};
        row.rmse = std::sqrt(mean_square(row.modelled, row.measured));
        fitted.push_back(std::move(row));
        first += count;
    }
    return fitted;
}

double root_mean_square(const std::vector<FittedSpectrum>& spectra) {
    double sum = 0.0;
    double count = 0.0;
    for (const FittedSpectrum& spectrum : spectra) {
        const auto readings = static_cast<double>(spectrum.measured.size());
        sum += readings * spectrum.rmse * spectrum.rmse;
        count += readings;
    }
    return spectra.size() == 1 ? spectra.front().rmse : std::sqrt(sum / count);
}

/// `FitResult::runs_p_value` of residuals of all spectra, one after the other.
std::optional<double> least_runs_p_value(const std::vector<FittedSpectrum>& spectra, const Eigen::VectorXd& residuals) {
    std::optional<double> least;
    const double* first = residuals.data();
    for (const FittedSpectrum& spectrum : spectra) {
        const std::optional<double> p_value = runs_p_value({first, spectrum.measured.size()});
        first += spectrum.measured.size();
        if (p_value) least = std::min(least.value_or(1.0), static_cast<double>(spectra.size()) * *p_value);
    }
    return least;
}

std::optional<double> chi2_p_value(double chi2, double degrees_of_freedom) {
    if (!(degrees_of_freedom > 0.0)) return std::nullopt;
    const boost::math::chi_squared_distribution<double> law(degrees_of_freedom);
    return boost::math::cdf(boost::math::complement(law, chi2));
}

/// How closely the model explains the spectra at `minimum`, and its own error.
void describe_misfit(const Objective& objective, const Minimum& minimum, std::span<const Spectrum> spectra,
                     FitResult& result) {
    const Objective::Modelled modelled = objective.model(minimum.values);
    result.spectra = fitted_spectra(objective.problem(), result.configuration, spectra, modelled.reading,
                                    objective.residuals(modelled.reading));
    result.rmse = root_mean_square(result.spectra);
    result.chi2 = minimum.chi2;
    result.cost = minimum.cost;
    result.degrees_of_freedom = degrees_of_freedom(objective, minimum);
    result.p_value = chi2_p_value(result.chi2, result.degrees_of_freedom);
    if (result.degrees_of_freedom > 0) result.inflation = std::sqrt(result.chi2 / result.degrees_of_freedom);
    const Eigen::VectorXd unexplained = objective.unexplained(modelled.reading);
    result.runs_p_value = least_runs_p_value(result.spectra, unexplained);
    result.unexplained = std::sqrt(unexplained.squaredNorm() / static_cast<double>(unexplained.size()));
    std::vector<double> sigmas;
    for (const FittedSpectrum& spectrum : result.spectra) {
        sigmas.insert(sigmas.end(), spectrum.sigma.begin(), spectrum.sigma.end());
    }
    result.median_sigma = median(sigmas);
    for (const MeasurementModel& model : objective.models()) {
        if (const auto* const emulator = std::get_if<Emulator>(&model.forward_model())) {
            result.emulator_error = std::max(result.emulator_error.value_or(0.0), emulator->certified_error());
        }
    }
    if (!result.emulator_error) {
        result.monte_carlo_error = median({modelled.standard_error.begin(), modelled.standard_error.end()});
    }
}

}  // namespace

std::vector<ForwardModel> make_models(const FitProblem& problem, Engine engine, const EnsembleCache& cache) {
    std::vector<ForwardModel> models;
    for (std::size_t k = 0; k < problem.measurements.size(); ++k) {
        const Measurement& measurement = problem.measurements[k];
        const Experiment& experiment = measurement.experiment;
        if (engine == Engine::solver) {
            models.emplace_back(angular_solver(experiment));
        } else if (engine == Engine::emulator) {
            models.emplace_back(cached_emulator(emulator_domain(problem, k), cache));
        } else {
            models.emplace_back(cached_ensemble(experiment.sample(),
                                                true_wavelengths_nm(experiment, measurement.bands.wavelength_nm),
                                                measurement.walk, cache));
        }
    }
    return models;
}

std::vector<ForwardModel> cheap_models(const FitProblem& problem, const std::vector<ForwardModel>& models) {
    constexpr std::uint64_t few_rays = 3000;
    std::vector<ForwardModel> cheap;
    for (std::size_t k = 0; k < models.size(); ++k) {
        if (const auto* const ensemble = std::get_if<PathEnsemble>(&models[k])) {
            cheap.emplace_back(ensemble->with_about(few_rays));
        } else if (std::holds_alternative<Emulator>(models[k])) {
            cheap.push_back(models[k]);
        } else {
            cheap.emplace_back(
                angular_solver(problem.measurements[k].experiment, AngularResolution::for_accuracy(1e-3)));
        }
    }
    return cheap;
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
        const FittedParameter& fitted = result.free[i];
        if (!fitted.uncertainty.sigma) continue;
        const double difference = std::abs(other.values[i] - fitted.value) / *fitted.uncertainty.sigma;
        largest = std::max(largest.value_or(0.0), difference);
    }
    return largest;
}

std::size_t reading_count(const FitResult& result) {
    std::size_t count = 0;
    for (const FittedSpectrum& spectrum : result.spectra) count += spectrum.measured.size();
    return count;
}

FitResult fit_spectra(const Configuration& configuration, std::span<const Spectrum> spectra,
                      const FitOptions& options) {
    const FitProblem problem = make_problem(configuration, spectra);
    const std::vector<ForwardModel> models = make_models(problem, configuration.engine, options.cache);
    const Objective objective(problem, models);
    const Objective cheap(problem, cheap_models(problem, models));
    Search found = search(cheap, objective, configuration.solver, configuration.starts);
    const Inference inference =
        infer(objective, found.minima.front().minimum, configuration.uncertainty, configuration.seed);
    const Minimum& minimum = inference.minimum;

    FitResult result;
    result.configuration = spectra.size() == 1 ? resolved(configuration, spectra.front()) : configuration;
    result.findings = options.findings;
    describe_misfit(objective, minimum, spectra, result);
    result.free = free_rows(problem, minimum, inference.uncertainty, configuration);
    result.fixed = fixed_rows(configuration);
    result.correlation = inference.uncertainty.correlation;
    result.identifiability = inference.identifiability;
    result.profile = inference.profile;
    result.posterior = inference.posterior;
    result.priors = priors_in_words(problem);
    result.answer = {.solver = configuration.solver, .minimum = minimum, .seconds = found.seconds};
    if (options.cross_check) result.cross_check = other_answers(cheap, objective, configuration);
    if (inference.profile && inference.profile->better_minimum) found.minima.push_back({.minimum = minimum});
    result.minima = distinct(objective, std::move(found.minima));
    const Diagnosis diagnosis = diagnose(result);
    result.verdict = diagnosis.verdict;
    result.reasons = diagnosis.reasons;
    return result;
}

FitResult fit_spectrum(const Configuration& configuration, const Spectrum& spectrum, const FitOptions& options) {
    return fit_spectra(configuration, std::span(&spectrum, 1), options);
}

}  // namespace skinfit
