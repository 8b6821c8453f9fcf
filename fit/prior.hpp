#pragma once

#include <variant>

#include "fit/configuration.hpp"

namespace skinfit {

/// A residual and its derivative by the quantity it judges.
struct Residual {
    double value;
    double slope;
};

/// The density of `prior` at x as a least-squares residual, exactly:
///
///     residual(x) = sign(x - mode) sqrt(2 log(p(mode) / p(x))),   so that residual^2 = -2 log p(x) + constant
///
/// with p the density with respect to x itself. Infinite where p is zero.
[[nodiscard]] Residual prior_residual(const Prior& prior, double x);

/// Where the density is largest.
[[nodiscard]] double mode(const Prior& prior);

/// The probability that `prior` gives to values within `bounds`.
[[nodiscard]] double mass_within(const Prior& prior, const Bounds& bounds);

/// The standard deviation of `prior` within `bounds`.
[[nodiscard]] double standard_deviation(const Prior& prior, const Bounds& bounds);

/// The value within `bounds` below which `prior` has the share `share` of its probability there: of a uniform number,
/// a draw.
[[nodiscard]] double quantile_within(const Prior& prior, const Bounds& bounds, double share);

/// The part of `bounds` in which a fit can move: an end at which the density is zero and the residual infinite is
/// replaced by the value where the density has fallen to exp(-32) of its largest, at a residual of 8.
[[nodiscard]] Bounds within_support(const Prior& prior, const Bounds& bounds);

}  // namespace skinfit
