#pragma once

#include "bench/stopwatch.hpp"
#include "fit/problem.hpp"

namespace skinfit {

/// A part of the fit that the analog walk makes: every evaluation traces all rays anew with the same random numbers,
/// and BOBYQA, which asks for no derivatives, minimises chi2 as `minimise_by_nlopt` does.
struct BruteForce {
    int evaluations;
    Duration duration;
    double chi2;  ///< the lowest met
};
[[nodiscard]] BruteForce fit_by_brute_force(const FitProblem& problem, int most_evaluations);

}  // namespace skinfit
