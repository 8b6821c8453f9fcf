#pragma once

#include <optional>
#include <variant>

#include "fit/configuration.hpp"

namespace skinfit {

/// A residual, or another function of one quantity, and its derivative by that quantity.
struct Residual {
    double value;
    double slope;
};

/// The normal score of x and its derivative: the coordinate in which `prior` is a standard normal distribution,
///
///     score(x) = Phi^-1(P(x)),
///
/// with P the distribution function of the prior and Phi that of the standard normal one: (x - mean) / sigma of a
/// normal prior, log(x / median) / sigma_log of a log-normal one. As a least-squares residual it is the prior: the
/// largest density, with respect to the score, lies at the median, and 95 % of the prior within 1.96, whatever the
/// scale of x. Infinite where x lies outside the support.
[[nodiscard]] Residual prior_residual(const Prior& prior, double x);

/// The value below which half of `prior` lies: its score is 0.
[[nodiscard]] double prior_median(const Prior& prior);

/// The logarithm of the density with respect to x itself, over its largest, and its derivative: of x within the
/// support.
[[nodiscard]] Residual log_density(const Prior& prior, double x);

/// The logarithm of the slope of the score, up to a constant, and its derivative; 0 outside the support. Added to the
/// normal density of the score it gives the density of x.
[[nodiscard]] Residual log_score_slope(const Prior& prior, double x);

/// The natural coordinate of a parameter, in which its uncertainty is judged: the score of its prior, and the value
/// itself where it has none; back, and the derivative of the coordinate by the value.
[[nodiscard]] double natural_coordinate(const std::optional<Prior>& prior, double value);
[[nodiscard]] double value_at_coordinate(const std::optional<Prior>& prior, double coordinate);
[[nodiscard]] double coordinate_slope(const std::optional<Prior>& prior, double value);

/// The probability that `prior` gives to values within `bounds`.
[[nodiscard]] double mass_within(const Prior& prior, const Bounds& bounds);

/// The value within `bounds` below which `prior` has the share `share` of its probability there: of a uniform number,
/// a draw.
[[nodiscard]] double quantile_within(const Prior& prior, const Bounds& bounds, double share);

/// The part of `bounds` in which a fit can move: an end at which the density is zero and the score infinite is replaced
/// by the value with a score of 8 in size.
[[nodiscard]] Bounds within_support(const Prior& prior, const Bounds& bounds);

}  // namespace skinfit
