#pragma once

#include <cmath>

#include "fit/configuration.hpp"
#include "fit/prior.hpp"

namespace skinfit {

/// A residual r after the loss: of the same sign, its square is rho(r^2), so that an outlier pulls less while the
/// problem stays one of least squares. With c the scale
///
///     huber: rho = r^2 up to |r| = c, 2 c |r| - c^2 beyond;   cauchy: rho = c^2 log(1 + r^2 / c^2)
///
/// `slope` is its derivative by r.
[[nodiscard]] inline Residual softened(double r, Loss loss, double scale) {
    const double size = std::abs(r);
    if (loss == Loss::squares || size == 0.0 || (loss == Loss::huber && size <= scale)) return {r, 1.0};
    if (loss == Loss::huber) {
        const double soft = std::sqrt(scale * (2.0 * size - scale));
        return {std::copysign(soft, r), scale / soft};
    }
    const double soft = scale * std::sqrt(std::log1p(size * size / (scale * scale)));
    return {std::copysign(soft, r), size / ((1.0 + size * size / (scale * scale)) * soft)};
}

}  // namespace skinfit
