#pragma once

#include <cmath>
#include <numbers>

namespace skinfit {

/// The 97.5 % quantile of the standard normal distribution: what 95 % of its values are no further away than from 0.
/// Its square is the 95 % quantile of chi-square with one degree of freedom.
inline constexpr double normal_95 = 1.9599639845400545;

/// The probability that a standard normal number lies below `score`.
[[nodiscard]] inline double normal_share_below(double score) {
    return 0.5 * std::erfc(-score / std::numbers::sqrt2);
}

}  // namespace skinfit
