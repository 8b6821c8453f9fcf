#include "bench/intervals.hpp"

#include <algorithm>
#include <limits>

#include "fit/inference.hpp"
#include "fit/misfit_description.hpp"
#include "fit/multistart.hpp"

namespace skinfit {
namespace {

/// The problem of spectrum `number`, the scale adjusted too.
FitProblem with_free_scale(const BenchWork& work, Eigen::Index number) {
    FitProblem problem = problem_of(work, number);
    const Bounds& bounds = work.configuration.bounds[static_cast<std::size_t>(Parameter::scale)];
    problem.free.push_back({.parameter = Parameter::scale, .start = 1.0, .bounds = bounds});
    return problem;
}

Duration median_of(const std::vector<Duration>& durations) {
    std::vector<double> wall_s;
    std::vector<double> cpu_s;
    for (const Duration& each : durations) {
        wall_s.push_back(each.wall_s);
        cpu_s.push_back(each.cpu_s);
    }
    return {.wall_s = median(wall_s), .cpu_s = median(cpu_s)};
}

}  // namespace

BenchIntervals measure_intervals(const BenchWork& work, const Emulator& emulator, std::size_t count) {
    BenchIntervals result{.spectra = count,
                          .profile = {},
                          .posterior = {},
                          .least_effective_draws = std::numeric_limits<double>::infinity(),
                          .profile_parameters = 0};
    std::vector<Duration> profiles;
    std::vector<Duration> posteriors;
    for (std::size_t k = 0; k < count; ++k) {
        const FitProblem problem = with_free_scale(work, static_cast<Eigen::Index>(k));
        const Objective objective(problem, ForwardModel(emulator));
        const Minimum minimum =
            distinct_minima(objective, objective, Solver::ceres, work.configuration.starts).minima.front().minimum;
        const Stopwatch profiling;
        const Inference profiled = infer(objective, minimum, UncertaintyMethod::profile, problem.seed);
        profiles.push_back(profiling.elapsed());
        result.profile_parameters = profiled.profile->intervals.size();
        const Stopwatch sampling;
        const Inference sampled = infer(objective, profiled.minimum, UncertaintyMethod::posterior, problem.seed);
        posteriors.push_back(sampling.elapsed());
        for (const Marginal& each : sampled.posterior->marginals) {
            result.least_effective_draws =
                std::min({result.least_effective_draws, each.bulk_effective_size, each.tail_effective_size});
        }
    }
    result.profile = median_of(profiles);
    result.posterior = median_of(posteriors);
    return result;
}

}  // namespace skinfit
