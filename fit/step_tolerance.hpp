#pragma once

namespace skinfit {

/// The step, as a share of the distance between the bounds, at which a search by Ceres ends.
inline constexpr double step_tolerance = 1e-9;

}  // namespace skinfit
