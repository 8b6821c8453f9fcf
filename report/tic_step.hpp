#pragma once

#include <cmath>

namespace skinfit {

/// The step of an axis' labels: 1, 2 or 5 times a power of ten, four or five of which make `range`; 1 for none.
[[nodiscard]] inline double tic_step(double range) {
    if (!(range > 0.0)) return 1.0;
    const double decade = std::pow(10.0, std::floor(std::log10(range / 4.0)));
    const double rest = range / 4.0 / decade;
    return decade * (rest >= 5.0 ? 5.0 : rest >= 2.0 ? 2.0 : 1.0);
}

}  // namespace skinfit
