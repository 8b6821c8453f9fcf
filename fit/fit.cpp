#include "fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"
#include "fit/diagnosis.hpp"
#include "fit/inference.hpp"
#include "fit/misfit_description.hpp"
#include "fit/model_band.hpp"
#include "fit/models.hpp"
#include "fit/multistart.hpp"
#include "fit/objective.hpp"
#include "fit/other_assumptions.hpp"
#include "fit/prior_json.hpp"
#include "fit/problem.hpp"

namespace skinfit {
namespace {

/// What one solver finds, and how long it took.
struct Search {
    Searches searches;
    double seconds;
};

Search search(const Objective& cheap, const Objective& objective, Solver solver, std::uint64_t count,
              const SearchLimits& limits, const FitWatch& watch) {
    const auto begin = std::chrono::steady_clock::now();
    Searches searches = distinct_minima(cheap, objective, solver, count, limits, watch);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    return {.searches = std::move(searches), .seconds = elapsed.count()};
}

/// Of each other solver, from the configured start. The angular solver takes so long that methods without derivatives
/// are stopped after a few seconds' worth of evaluations; their answers stand as they are.
std::vector<SolverAnswer> other_answers(const Objective& cheap, const Objective& objective,
                                        const FitSettings& configuration, const FitWatch& watch) {
    SearchLimits limits;
    if (configuration.engine == Engine::solver) limits = {.cheap_evaluations = 600, .evaluations = 60};
    std::vector<SolverAnswer> answers;
    for (std::size_t i = 0; i < solver_count; ++i) {
        const auto solver = static_cast<Solver>(i);
        if (solver == configuration.solver) continue;
        watch.tell({.stage = "cross-checking", .done = answers.size(), .total = solver_count - 1});
        Search other = search(cheap, objective, solver, 1, limits, {});
        answers.push_back(
            {.solver = solver, .minimum = std::move(other.searches.minima.front().minimum), .seconds = other.seconds});
    }
    return answers;
}

/// What is computed once the minimum is known, as far as it got.
struct AfterSearch {
    std::optional<Inference> inference;   ///< none where it was stopped
    std::vector<SolverAnswer> others;     ///< of the cross-check
    std::vector<std::string> unfinished;  ///< in words
};

AfterSearch after_search(const Objective& cheap, const Objective& objective, const Minimum& minimum,
                         const FitSettings& configuration, const FitOptions& options) {
    AfterSearch after;
    try {
        after.inference = infer(objective, minimum, configuration.uncertainty, configuration.seed);
        if (options.cross_check) after.others = other_answers(cheap, objective, configuration, options.watch);
    } catch (const Cancelled&) {
        if (!options.watch.keeps_partial_result) throw;
        if (!after.inference)
            after.unfinished.push_back(
                fmt::format("the intervals by {} (those shown are by covariance)",
                            uncertainty_names[static_cast<std::size_t>(configuration.uncertainty)]));
        if (options.cross_check) after.unfinished.emplace_back("the cross-check");
    }
    return after;
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

std::vector<FittedParameter> free_rows(const FitProblem& problem, const Minimum& minimum,
                                       const Uncertainty& uncertainty) {
    std::vector<FittedParameter> rows;
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const FreeParameter& free = problem.free[i];
        rows.push_back({.parameter = free.parameter,
                        .name = name_of(free),
                        .value = minimum.values[i],
                        .start = free.start,
                        .bounds = free.bounds,
                        .uncertainty = uncertainty.parameters[i],
                        .prior = free.prior});
    }
    return rows;
}

void try_others(const Objective& objective, const std::vector<ForwardModel>& models, const Minimum& minimum,
                const FitWatch& watch, FitResult& result) {
    watch.tell({.stage = "trying other assumptions", .done = 0, .total = 1});
    try {
        result.other_assumptions = try_other_assumptions(result, objective, models, minimum);
    } catch (const Cancelled&) {
        if (!watch.keeps_partial_result) throw;
        result.unfinished.emplace_back("the comparison with other assumptions");
    }
}

/// Gives each spectrum its part of the band of all readings.
void add_model_band(const std::vector<Bounds>& band, std::vector<FittedSpectrum>& spectra) {
    auto first = band.begin();
    for (FittedSpectrum& spectrum : spectra) {
        const auto last = first + static_cast<std::ptrdiff_t>(spectrum.modelled.size());
        spectrum.modelled_95.assign(first, last);
        first = last;
    }
}

std::vector<FittedParameter> fixed_rows(const FitSettings& configuration) {
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

}  // namespace

FitResult fit_spectra(const FitInput& input, const FitOptions& options) {
    check_freedom(input.parts.front().configuration, "free");
    const FitProblem problem = make_problem(input);
    const FitSettings& configuration = problem.measurements.front().configuration;
    const FitWatch& watch = options.watch;
    watch.tell({.stage = "preparing the model", .done = 0, .total = 1});
    const std::vector<ForwardModel> models =
        options.models ? options.models(problem, configuration.engine)
                       : make_models(problem, configuration.engine, options.cache, watch.stop);
    const Objective watched(problem, models, watch.stop);
    const Objective cheap(problem, cheap_models(problem, models), watch.stop);
    Search found = search(cheap, watched, configuration.solver, configuration.starts, {}, watch);
    watch.tell({.stage = "estimating the uncertainty", .done = 0, .total = 1});
    const Minimum best = found.searches.minima.front().minimum;
    AfterSearch after = after_search(cheap, watched, best, configuration, options);
    // A stop ends what heeds it, and must not end what is left to do.
    std::optional<Objective> unwatched;
    if (watch.keeps_partial_result) unwatched.emplace(problem, models);
    const Objective& objective = unwatched ? *unwatched : watched;
    const Inference inference =
        after.inference ? *after.inference : infer(objective, best, UncertaintyMethod::covariance, configuration.seed);
    const Minimum& minimum = inference.minimum;

    FitResult result;
    result.configuration = problem.measurements.size() == 1 ? as_stated(problem.only().configuration) : input.stated;
    if (!after.inference) result.configuration.uncertainty = UncertaintyMethod::covariance;
    result.unfinished = std::move(after.unfinished);
    result.findings = options.findings;
    describe_misfit(objective, minimum, result);
    add_model_band(model_band(objective, inference), result.spectra);
    result.free = free_rows(problem, minimum, inference.uncertainty);
    result.fixed = fixed_rows(configuration);
    result.correlation = inference.uncertainty.correlation;
    result.identifiability = inference.identifiability;
    result.profile = inference.profile;
    result.posterior = inference.posterior;
    result.priors = priors_in_words(problem);
    result.answer = {.solver = configuration.solver, .minimum = minimum, .seconds = found.seconds};
    result.cross_check = std::move(after.others);
    result.searches = std::move(found.searches);
    std::vector<DistinctMinimum>& minima = result.searches.minima;
    if (inference.profile && inference.profile->better_minimum) minima.push_back({.minimum = minimum});
    minima = distinct(objective, std::move(minima));
    try_others(watched, models, minimum, watch, result);
    const Diagnosis diagnosis = diagnose(result);
    result.verdict = diagnosis.verdict;
    result.reasons = diagnosis.reasons;
    return result;
}

FitResult fit_spectra(const Configuration& configuration, std::span<const Spectrum> spectra,
                      const FitOptions& options) {
    return fit_spectra(fit_input(configuration, spectra), options);
}

FitResult fit_spectrum(const Configuration& configuration, const Spectrum& spectrum, const FitOptions& options) {
    return fit_spectra(configuration, std::span(&spectrum, 1), options);
}

}  // namespace skinfit
