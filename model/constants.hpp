#pragma once

#include <numbers>

namespace skinfit {

/// Factors of units.
inline constexpr double pi = std::numbers::pi;
inline constexpr double rad_per_deg = pi / 180.0;
inline constexpr double cm_per_nm = 1e-7;

}  // namespace skinfit
