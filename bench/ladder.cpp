#include "bench/ladder.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <memory>
#include <utility>

#include "bench/brute_force.hpp"
#include "bench/threads.hpp"
#include "bench/work.hpp"
#include "fit/bulk.hpp"
#include "fit/emulation.hpp"
#include "fit/fit.hpp"
#include "fit/misfit_description.hpp"
#include "fit/models.hpp"
#include "fit/multistart.hpp"
#include "fit/uncertainty.hpp"

namespace skinfit {
namespace {

using Index = Eigen::Index;
constexpr double megabyte = 1024.0 * 1024.0;

/// One fit of a rung.
struct TimedFit {
    std::vector<double> values;
    double chi2;
    int evaluations;
    Duration duration{};
};
using TimedFits = std::vector<TimedFit>;

TimedFit of(const Minimum& minimum) {
    return {.values = minimum.values, .chi2 = minimum.chi2, .evaluations = minimum.evaluations};
}

TimedFits timed_fits(const BenchWork& work, std::size_t count, const std::function<TimedFit(const FitProblem&)>& fit) {
    TimedFits fits;
    for (std::size_t i = 0; i < count; ++i) {
        const FitProblem problem = problem_of(work, static_cast<Index>(i));
        const Stopwatch watch;
        fits.push_back(fit(problem));
        fits.back().duration = watch.elapsed();
    }
    return fits;
}

template <class Of>
double median_of(const TimedFits& fits, Of of_fit) {
    std::vector<double> numbers;
    for (const TimedFit& fit : fits) numbers.push_back(of_fit(fit));
    return median(numbers);
}

BenchRung rung_of(const std::string& name, const std::string& what, const TimedFits& fits, double model_mb) {
    return {.name = name,
            .what = what,
            .spectra = fits.size(),
            .median = {.wall_s = median_of(fits, [](const TimedFit& fit) { return fit.duration.wall_s; }),
                       .cpu_s = median_of(fits, [](const TimedFit& fit) { return fit.duration.cpu_s; })},
            .evaluations = median_of(fits, [](const TimedFit& fit) { return static_cast<double>(fit.evaluations); }),
            .model_mb = model_mb,
            .accuracy = std::nullopt};
}

/// The solver's fit that counts, with its sigmas.
struct Reference {
    std::unique_ptr<FitProblem> problem;  // to which the objective refers
    Objective objective;
    Minimum minimum;
    Uncertainty uncertainty;
};

/// How far the fits of one rung lie from the references of their spectra.
BenchAccuracy accuracy_of(const TimedFits& fits, const std::vector<Reference>& references) {
    constexpr double another_minimum = 1.0;
    BenchAccuracy accuracy;
    std::vector<double> largest;
    for (std::size_t i = 0; i < references.size(); ++i) {
        const Reference& reference = references[i];
        if (!(reference.objective.chi2(fits[i].values) - reference.minimum.chi2 < another_minimum)) {
            ++accuracy.other_minima;
            continue;
        }
        largest.push_back(0.0);
        for (std::size_t j = 0; j < fits[i].values.size(); ++j) {
            const std::optional<double> sigma = reference.uncertainty.parameters[j].sigma;
            if (!sigma) continue;
            const double difference = std::abs(fits[i].values[j] - reference.minimum.values[j]) / *sigma;
            largest.back() = std::max(largest.back(), difference);
        }
    }
    accuracy.median_sigmas = median(largest);
    if (!largest.empty()) accuracy.worst_sigmas = *std::ranges::max_element(largest);
    return accuracy;
}

double megabytes_of(const Emulator& emulator) {
    const Emulator::Parts parts = emulator.parts();
    return static_cast<double>(parts.coefficients.size_bytes() + parts.counts.size_bytes() +
                               parts.groups.size() * sizeof parts.groups[0]) /
           megabyte;
}

/// A search for several minima as `fit_spectrum` makes it, with its uncertainty.
TimedFit fit_as_configured(const FitProblem& problem, const ForwardModel& model, const ForwardModel& cheap,
                           std::uint64_t starts) {
    const Objective objective(problem, model);
    const std::vector<DistinctMinimum> minima =
        distinct_minima(Objective(problem, cheap), objective, Solver::ceres, starts).minima;
    (void)estimate_uncertainty(objective, minima.front().minimum);
    TimedFit fit = of(minima.front().minimum);
    fit.evaluations = 0;
    for (const DistinctMinimum& each : minima) fit.evaluations += each.minimum.evaluations;
    return fit;
}

TimedFit fit_once(const FitProblem& problem, const ForwardModel& model) {
    const Objective objective(problem, model);
    const Minimum minimum = minimise_by_ceres(objective, starts(problem));
    (void)estimate_uncertainty(objective, minimum);
    return of(minimum);
}

/// From the lowest minimum of any rung.
std::vector<Reference> references_of(const BenchWork& work, const ForwardModel& solver, std::size_t count,
                                     const std::vector<TimedFits>& rungs) {
    std::vector<Reference> references;
    for (std::size_t i = 0; i < count; ++i) {
        auto problem = std::make_unique<FitProblem>(problem_of(work, static_cast<Index>(i)));
        Objective objective(*problem, solver);
        const auto lowest = std::ranges::min_element(rungs, {}, [&](const TimedFits& fits) { return fits[i].chi2; });
        Minimum minimum = minimise_by_ceres(objective, (*lowest)[i].values);
        Uncertainty uncertainty = estimate_uncertainty(objective, minimum);
        references.push_back({std::move(problem), std::move(objective), std::move(minimum), std::move(uncertainty)});
    }
    return references;
}

/// What the rungs compute by.
struct LadderModels {
    Emulator emulator;
    PathEnsemble ensemble;
    ForwardModel solver;
};

/// The fits of every rung but brute force.
struct LadderFits {
    TimedFits once;        // recorded paths
    TimedFits configured;  // recorded paths, as `skinfit fit` searches
    TimedFits by_solver;
    TimedFits emulated;
    TimedFits lean;
};

LadderModels built_models(const BenchWork& work, BenchResult& result) {
    const Stopwatch building;
    Emulator emulator = Emulator::build(emulator_domain(work.problem));
    result.build = building.elapsed();
    result.certified_error = emulator.certified_error();
    return {.emulator = std::move(emulator),
            .ensemble = recorded(work.problem),
            .solver = angular_solver(work.problem.only().experiment)};
}

/// `solved` is how many of the spectra the angular solver fits.
LadderFits fitted(const BenchWork& work, const LadderModels& models, std::size_t spectra, std::size_t solved,
                  const BenchListener& tell) {
    LadderFits fits;
    const std::uint64_t starts = work.configuration.starts;
    tell("fitting by the emulator");
    const BulkFitter fitter(work.problem, models.emulator);
    fits.lean = timed_fits(work, spectra, [&](const FitProblem& each) {
        const Eigen::Map<const Eigen::VectorXd> measured(each.only().measured.data(),
                                                         static_cast<Index>(each.only().measured.size()));
        const BulkFit fit = fitter.fit(measured);
        return TimedFit{.values = fit.values, .chi2 = fit.chi2, .evaluations = fit.evaluations};
    });
    fits.emulated = timed_fits(work, spectra, [&](const FitProblem& each) {
        return fit_as_configured(each, models.emulator, models.emulator, starts);
    });
    tell("fitting by recorded paths");
    fits.once = timed_fits(work, spectra, [&](const FitProblem& each) { return fit_once(each, models.ensemble); });
    const ForwardModel few = cheap_models(work.problem, {models.ensemble}).front();
    fits.configured = timed_fits(
        work, solved, [&](const FitProblem& each) { return fit_as_configured(each, models.ensemble, few, starts); });
    tell("fitting by the angular solver");
    fits.by_solver = timed_fits(work, solved, [&](const FitProblem& each) { return fit_once(each, models.solver); });
    return fits;
}

/// A fit by brute force: some of its evaluations timed, extrapolated to those that BOBYQA takes over recorded paths.
TimedFits extrapolated_brute_force(const BenchWork& work, const PathEnsemble& ensemble, BenchResult& result) {
    const FitProblem first = problem_of(work, 0);
    const BruteForce brute = fit_by_brute_force(first, result.sizes.brute_force_evaluations);
    const int needed = minimise_by_nlopt(Objective(first, ensemble), Solver::bobyqa, starts(first)).evaluations;
    result.brute_force_timed = brute.evaluations;
    result.brute_force_evaluation = {.wall_s = brute.duration.wall_s / brute.evaluations,
                                     .cpu_s = brute.duration.cpu_s / brute.evaluations};
    return {{.values = {},
             .chi2 = brute.chi2,
             .evaluations = needed,
             .duration = {.wall_s = result.brute_force_evaluation.wall_s * needed,
                          .cpu_s = result.brute_force_evaluation.cpu_s * needed}}};
}

std::vector<BenchRung> rungs_of(const LadderFits& fits, const TimedFits& brute_force, const LadderModels& models) {
    const double recording_mb = static_cast<double>(models.ensemble.recording().lengths.size_bytes()) / megabyte;
    const double emulator_mb = megabytes_of(models.emulator);
    return {
        rung_of("brute_force", "analog walk traced anew at every evaluation, BOBYQA; extrapolated", brute_force, 0.0),
        rung_of("paths", "recorded paths, one search by Ceres", fits.once, recording_mb),
        rung_of("paths_as_fit", "recorded paths, as `skinfit fit` searches", fits.configured, recording_mb),
        rung_of("solver", "angular solver, one search by Ceres", fits.by_solver, 0.0),
        rung_of("emulator_as_fit", "emulator, as `skinfit fit` searches", fits.emulated, emulator_mb),
        rung_of("emulator", "emulator, lean fit of one spectrum (fit/bulk)", fits.lean, emulator_mb)};
}

/// Of all rungs but brute force, each against the solver's fits of the first `solved` spectra.
void compare_answers(const BenchWork& work, const ForwardModel& solver, std::size_t solved, const LadderFits& fits,
                     BenchResult& result) {
    const std::vector<Reference> references =
        references_of(work, solver, solved, {fits.lean, fits.emulated, fits.once, fits.configured, fits.by_solver});
    const std::vector<const TimedFits*> in_order = {&fits.once, &fits.configured, &fits.by_solver, &fits.emulated,
                                                    &fits.lean};
    for (std::size_t i = 0; i < in_order.size(); ++i) {
        result.rungs[i + 1].accuracy = accuracy_of(*in_order[i], references);
    }
}

}  // namespace

const BenchRung& rung(const BenchResult& result, std::string_view name) {
    const auto found = std::ranges::find(result.rungs, name, &BenchRung::name);
    assert(found != result.rungs.end());
    return *found;
}

BenchResult measure_ladder(const BenchSizes& sizes, const BenchListener& tell) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
    const Stopwatch whole;
    tell("simulating spectra");
    const BenchWork work = bench_work(sizes.spectra, sizes.rays);
    BenchResult result{};
    result.sizes = sizes;
    result.machine = machine_name();
    result.compiler = "g++ " __VERSION__;
    tell("building the models");
    const LadderModels models = built_models(work, result);
    const std::size_t solved = std::min(sizes.spectra, sizes.solver_spectra);
    const LadderFits fits = fitted(work, models, sizes.spectra, solved, tell);
    tell("fitting by brute force");
    result.rungs = rungs_of(fits, extrapolated_brute_force(work, models.ensemble, result), models);
    tell("comparing the answers");
    compare_answers(work, models.solver, solved, fits, result);
    tell("measuring one thread and two");
    measure_threads(work, models.ensemble, models.emulator, result);
    tell("measuring intervals");
    result.intervals = measure_intervals(work, models.emulator, solved);
    result.peak_mb = peak_memory_mb();
    result.whole = whole.elapsed();
    return result;
}

}  // namespace skinfit
