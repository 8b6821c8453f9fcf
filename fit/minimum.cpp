#include "fit/minimum.hpp"

#include <algorithm>

namespace skinfit {

std::vector<double> to_unit_box(const FitProblem& problem, std::span<const double> values) {
    std::vector<double> positions;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Bounds& bounds = problem.free[i].bounds;
        positions.push_back((values[i] - bounds.lower) / (bounds.upper - bounds.lower));
    }
    return positions;
}

std::vector<double> from_unit_box(const FitProblem& problem, std::span<const double> positions) {
    std::vector<double> values;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Bounds& bounds = problem.free[i].bounds;
        // Exactly the bound at 0 and 1, whatever the rounding.
        const double value =
            positions[i] == 1.0 ? bounds.upper : bounds.lower + positions[i] * (bounds.upper - bounds.lower);
        values.push_back(value);
    }
    return values;
}

std::vector<double> starts(const FitProblem& problem) {
    std::vector<double> values;
    for (const FreeParameter& free : problem.free) values.push_back(free.start);
    return values;
}

}  // namespace skinfit
