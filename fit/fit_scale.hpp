#pragma once

#include <span>
#include <vector>

#include "fit/problem.hpp"

/// The coordinates in which solvers work: positions in the unit box.
///
/// A pigment's effect on the spectrum saturates: the step from 1 to 2 % melanosomes shows as much as that from 10 to
/// 20 %. Where a parameter spans decades its position is therefore logarithmic above a knee k and linear below it,
///
///     position = log(1 + (value - lower) / k) / log(1 + (upper - lower) / k),
///
/// with a slope at both bounds, so that each can be reached and left. The others are linear between their bounds. What
/// is minimised and reported does not depend on this.
namespace skinfit {

/// Whether the parameter's position is logarithmic, within its default bounds; sliders of the page follow.
[[nodiscard]] bool has_logarithmic_scale(Parameter parameter);

/// The position of each free parameter between its bounds, 0 to 1, and back; 0 and 1 are the bounds exactly.
[[nodiscard]] std::vector<double> to_unit_box(const FitProblem& problem, std::span<const double> values);
[[nodiscard]] std::vector<double> from_unit_box(const FitProblem& problem, std::span<const double> positions);

/// The derivative of each free parameter by its position; above 0.
[[nodiscard]] std::vector<double> unit_box_slopes(const FitProblem& problem, std::span<const double> positions);

}  // namespace skinfit
