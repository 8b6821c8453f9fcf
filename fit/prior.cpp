#include "fit/prior.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/log1p.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/critical_values.hpp"

namespace skinfit {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double farthest_score = 8.0;
const boost::math::normal_distribution<double> standard_normal;

Residual score_of(const NormalPrior& prior, double x) {
    return {.value = (x - prior.mean) / prior.sigma, .slope = 1.0 / prior.sigma};
}

Residual score_of(const LogNormalPrior& prior, double x) {
    if (!(x > 0.0)) return {.value = -infinite, .slope = infinite};
    return {.value = std::log(x / prior.median) / prior.sigma_log, .slope = 1.0 / (x * prior.sigma_log)};
}

/// From the smaller tail, so that it is not rounded away.
Residual score_of(const BetaPrior& prior, double x) {
    const double below = boost::math::ibeta(prior.a, prior.b, std::clamp(x, 0.0, 1.0));
    const double above = boost::math::ibetac(prior.a, prior.b, std::clamp(x, 0.0, 1.0));
    if (below == 0.0) return {.value = -infinite, .slope = infinite};
    if (above == 0.0) return {.value = infinite, .slope = infinite};
    const double score = below < above ? boost::math::quantile(standard_normal, below)
                                       : boost::math::quantile(boost::math::complement(standard_normal, above));
    return {.value = score,
            .slope = boost::math::ibeta_derivative(prior.a, prior.b, x) / boost::math::pdf(standard_normal, score)};
}

double value_at(const NormalPrior& prior, double score) {
    return prior.mean + score * prior.sigma;
}

double value_at(const LogNormalPrior& prior, double score) {
    return prior.median * std::exp(score * prior.sigma_log);
}

double value_at(const BetaPrior& prior, double score) {
    return score < 0.0 ? boost::math::ibeta_inv(prior.a, prior.b, normal_share_below(score))
                       : boost::math::ibetac_inv(prior.a, prior.b, normal_share_below(-score));
}

Residual log_density_of(const NormalPrior& prior, double x) {
    const Residual score = score_of(prior, x);
    return {.value = -0.5 * score.value * score.value, .slope = -score.value * score.slope};
}

/// -log p = log x + (log x - log median)^2 / (2 sigma_log^2) is a square again, about the largest density.
Residual log_density_of(const LogNormalPrior& prior, double x) {
    const double z = std::log(x / prior.median) / prior.sigma_log + prior.sigma_log;
    return {.value = -0.5 * z * z, .slope = -z / (x * prior.sigma_log)};
}

/// log(ratio) - (ratio - 1) with t = ratio - 1 given: without rounding near 1, without overflow near 0.
double log_minus_linear(double t, double ratio) {
    return std::abs(t) < 0.5 ? boost::math::log1pmx(t) : std::log(ratio) - t;
}

/// With d the distance from the largest density the terms linear in d cancel.
Residual log_density_of(const BetaPrior& prior, double x) {
    const double total = prior.a + prior.b - 2.0;
    const double largest = (prior.a - 1.0) / total;
    const double d = x - largest;
    return {.value = (prior.a - 1.0) * log_minus_linear(d / largest, x / largest) +
                     (prior.b - 1.0) * log_minus_linear(-d / (1.0 - largest), (1.0 - x) / (1.0 - largest)),
            .slope = -total * d / (x * (1.0 - x))};
}

double share_below(const NormalPrior& prior, double x) {
    return normal_share_below((x - prior.mean) / prior.sigma);
}

double share_below(const LogNormalPrior& prior, double x) {
    return x > 0.0 ? normal_share_below(std::log(x / prior.median) / prior.sigma_log) : 0.0;
}

double share_below(const BetaPrior& prior, double x) {
    return boost::math::ibeta(prior.a, prior.b, std::clamp(x, 0.0, 1.0));
}

double quantile_of(const NormalPrior& prior, double share) {
    return value_at(prior, boost::math::quantile(standard_normal, share));
}

double quantile_of(const LogNormalPrior& prior, double share) {
    return value_at(prior, boost::math::quantile(standard_normal, share));
}

double quantile_of(const BetaPrior& prior, double share) {
    return boost::math::ibeta_inv(prior.a, prior.b, share);
}

}  // namespace

Residual prior_residual(const Prior& prior, double x) {
    return std::visit([x](const auto& kind) { return score_of(kind, x); }, prior);
}

double prior_median(const Prior& prior) {
    return value_at_coordinate(prior, 0.0);
}

Residual log_density(const Prior& prior, double x) {
    return std::visit([x](const auto& kind) { return log_density_of(kind, x); }, prior);
}

Residual log_score_slope(const Prior& prior, double x) {
    const Residual score = prior_residual(prior, x);
    if (!std::isfinite(score.value)) return {.value = 0.0, .slope = 0.0};
    const Residual density = log_density(prior, x);
    return {.value = density.value + 0.5 * score.value * score.value,
            .slope = density.slope + score.value * score.slope};
}

double natural_coordinate(const std::optional<Prior>& prior, double value) {
    return prior ? prior_residual(*prior, value).value : value;
}

double value_at_coordinate(const std::optional<Prior>& prior, double coordinate) {
    if (!prior) return coordinate;
    return std::visit([coordinate](const auto& kind) { return value_at(kind, coordinate); }, *prior);
}

double coordinate_slope(const std::optional<Prior>& prior, double value) {
    return prior ? prior_residual(*prior, value).slope : 1.0;
}

double mass_within(const Prior& prior, const Bounds& bounds) {
    return std::visit(
        [&bounds](const auto& kind) { return share_below(kind, bounds.upper) - share_below(kind, bounds.lower); },
        prior);
}

double quantile_within(const Prior& prior, const Bounds& bounds, double share) {
    return std::visit(
        [&](const auto& kind) {
            const double below = share_below(kind, bounds.lower);
            const double within = share_below(kind, bounds.upper) - below;
            return std::clamp(quantile_of(kind, below + share * within), bounds.lower, bounds.upper);
        },
        prior);
}

Bounds within_support(const Prior& prior, const Bounds& bounds) {
    const auto has_density = [&prior](double x) { return std::isfinite(prior_residual(prior, x).value); };
    // A score may lie nearer to 1 than a number can.
    const double largest = std::nextafter(bounds.upper, bounds.lower);
    return {has_density(bounds.lower) ? bounds.lower : value_at_coordinate(prior, -farthest_score),
            has_density(bounds.upper) ? bounds.upper : std::min(value_at_coordinate(prior, farthest_score), largest)};
}

}  // namespace skinfit
