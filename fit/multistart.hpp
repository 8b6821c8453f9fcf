#pragma once

#include <vector>

#include "fit/fit_watch.hpp"
#include "fit/minimum.hpp"

namespace skinfit {

/// A minimum of the cost, and how many searches ended there.
struct DistinctMinimum {
    Minimum minimum;
    int searches = 0;
};

/// What searches from several starts found.
struct Searches {
    std::vector<DistinctMinimum> minima;  ///< finished ones, best first; never empty
    std::size_t starts = 0;               ///< each of them was searched from once
    std::size_t rough_minima = 0;         ///< distinct ones at which those searches ended
    std::size_t finished = 0;             ///< the best of them, `most_finished` at most; the others were left out
};

/// More minima than these are not worth the whole model: those that are left out have the highest costs.
inline constexpr std::size_t most_finished = 6;

/// `count` points spread evenly over the unit box of `dimensions` dimensions: multiples of the generalised golden
/// ratio [ROBERTS18], shifted at random as `seed` says.
[[nodiscard]] std::vector<std::vector<double>> spread_points(std::size_t count, std::size_t dimensions,
                                                             std::uint64_t seed);

/// `minima` of `objective` without repetitions, best first: two are one where the data cannot tell them apart, their
/// linearised residuals differ by less than 0.1 sigma in all and their costs by less than 0.01.
[[nodiscard]] std::vector<DistinctMinimum> distinct(const Objective& objective, std::vector<DistinctMinimum> minima);

/// What a search by a method without derivatives may cost; unset: as much as it wants.
struct SearchLimits {
    std::optional<int> cheap_evaluations{};  ///< of each search
    std::optional<int> evaluations{};        ///< for finishing a minimum
};

/// Minimises from `count` starts: the problem's, and points spread over its bounds. Each search goes over `cheap`, an
/// approximation of `objective` on the same problem; the best distinct minima found there are then finished on
/// `objective`. Evaluations of a minimum are those of both. `watch` is told of each search.
[[nodiscard]] Searches distinct_minima(const Objective& cheap, const Objective& objective, Solver solver,
                                       std::size_t count, const SearchLimits& limits = {}, const FitWatch& watch = {});

}  // namespace skinfit
