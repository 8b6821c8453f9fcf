#include "fit/multistart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/random.hpp"

namespace skinfit {
namespace {

/// What two minima may differ by and still be one.
struct Tolerance {
    double sigmas;
    double cost;
};

/// Merges `found` into the clusters of `objective`, whose first members represent them; best first.
std::vector<DistinctMinimum> clustered(const Objective& objective, std::vector<DistinctMinimum> found,
                                       const Tolerance& tolerance) {
    std::ranges::stable_sort(found, {}, [](const DistinctMinimum& each) { return each.minimum.cost; });
    std::vector<DistinctMinimum> distinct;
    std::vector<Eigen::MatrixXd> jacobians;
    for (DistinctMinimum& each : found) {
        const auto same = [&](std::size_t k) {
            const Minimum& known = distinct[k].minimum;
            Eigen::VectorXd step(static_cast<Eigen::Index>(known.values.size()));
            for (std::size_t i = 0; i < known.values.size(); ++i) {
                step[static_cast<Eigen::Index>(i)] = each.minimum.values[i] - known.values[i];
            }
            return each.minimum.cost - known.cost < tolerance.cost && (jacobians[k] * step).norm() < tolerance.sigmas;
        };
        std::size_t k = 0;
        while (k < distinct.size() && !same(k)) ++k;
        if (k < distinct.size()) {
            distinct[k].searches += each.searches;
            distinct[k].minimum.evaluations += each.minimum.evaluations;
            continue;
        }
        jacobians.push_back(objective.misfit(each.minimum.values).jacobian);
        distinct.push_back(std::move(each));
    }
    return distinct;
}

}  // namespace

std::vector<std::vector<double>> spread_points(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
    // The generalised golden ratio: the positive root of x^(d+1) = x + 1. The fixed point contracts by 1/(d+1) or more.
    double ratio = 2.0;
    for (int i = 0; i < 60; ++i) ratio = std::pow(1.0 + ratio, 1.0 / (static_cast<double>(dimensions) + 1.0));
    constexpr std::uint64_t beyond_all_rays = std::numeric_limits<std::uint64_t>::max();
    std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
    for (std::size_t d = 0; d < dimensions; ++d) {
        const double shift = RandomRay(seed, beyond_all_rays).uniforms(static_cast<std::uint32_t>(d), 0)[0];
        const double step = std::pow(ratio, -static_cast<double>(d + 1));
        for (std::size_t k = 0; k < count; ++k) {
            const double position = shift + static_cast<double>(k + 1) * step;
            points[k][d] = position - std::floor(position);
        }
    }
    return points;
}

std::vector<DistinctMinimum> distinct(const Objective& objective, std::vector<DistinctMinimum> minima) {
    return clustered(objective, std::move(minima), {.sigmas = 0.1, .cost = 0.01});
}

Searches distinct_minima(const Objective& cheap, const Objective& objective, Solver solver, std::size_t count,
                         const SearchLimits& limits, const FitWatch& watch) {
    const FitProblem& problem = objective.problem();
    std::vector<std::vector<double>> from = {starts(problem)};
    for (const std::vector<double>& point : spread_points(count - 1, problem.free.size(), problem.seed)) {
        from.push_back(from_unit_box(problem, point));
    }
    // Searches over the cheap model end where its own noise lets them.
    constexpr Tolerance rough{.sigmas = 0.5, .cost = 0.25};
    std::vector<DistinctMinimum> found;
    for (const std::vector<double>& start : from) {
        watch.tell({.stage = "searching", .done = found.size(), .total = from.size()});
        found.push_back({.minimum = minimise(cheap, solver, start, limits.cheap_evaluations), .searches = 1});
    }
    std::vector<DistinctMinimum> finished = clustered(cheap, std::move(found), rough);
    Searches searches{.minima = {}, .starts = from.size(), .rough_minima = finished.size()};
    if (finished.size() > most_finished) finished.resize(most_finished);
    searches.finished = finished.size();
    const Solver finisher = solver == Solver::crs2 ? Solver::bobyqa : solver;
    std::size_t done = 0;
    for (DistinctMinimum& each : finished) {
        watch.tell({.stage = "refining", .done = done++, .total = finished.size()});
        const int before = each.minimum.evaluations;
        each.minimum = minimise(objective, finisher, each.minimum.values, limits.evaluations);
        each.minimum.evaluations += before;
    }
    searches.minima = distinct(objective, std::move(finished));
    return searches;
}

}  // namespace skinfit
