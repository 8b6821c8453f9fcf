#pragma once

#include <string>

#include "fit/result.hpp"

namespace skinfit {

/// The profile of each free parameter of `result`, which has them: the points that were evaluated and the curve through
/// them, the threshold of the 95 % interval and the interval's ends, what the covariance has in its place,
/// and what lies beyond the bounds of the fit, shaded. As SVG by gnuplot. Throws InputError when gnuplot is missing or
/// fails.
[[nodiscard]] std::string profile_picture(const FitResult& result);

}  // namespace skinfit
