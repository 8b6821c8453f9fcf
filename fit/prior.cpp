#include "fit/prior.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/log1p.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

namespace skinfit {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double farthest_residual = 8.0;

double normal_share_below(double z) {
    return boost::math::cdf(boost::math::normal_distribution<double>(), z);
}

Residual residual_of(const NormalPrior& prior, double x) {
    return {.value = (x - prior.mean) / prior.sigma, .slope = 1.0 / prior.sigma};
}

/// -log p = log x + (log x - log median)^2 / (2 sigma_log^2) is a square again, about the mode.
Residual residual_of(const LogNormalPrior& prior, double x) {
    if (!(x > 0.0)) return {.value = -infinite, .slope = infinite};
    return {.value = std::log(x / mode(prior)) / prior.sigma_log, .slope = 1.0 / (x * prior.sigma_log)};
}

/// log(ratio) - (ratio - 1) with t = ratio - 1 given: without rounding near 1, without overflow near 0.
double log_minus_linear(double t, double ratio) {
    return std::abs(t) < 0.5 ? boost::math::log1pmx(t) : std::log(ratio) - t;
}

/// With d = x - mode the terms of the log density linear in d cancel.
Residual residual_of(const BetaPrior& prior, double x) {
    if (!(x > 0.0)) return {.value = -infinite, .slope = infinite};
    if (!(x < 1.0)) return {.value = infinite, .slope = infinite};
    const double at_mode = mode(prior);
    const double d = x - at_mode;
    const double fall = -(prior.a - 1.0) * log_minus_linear(d / at_mode, x / at_mode) -
                        (prior.b - 1.0) * log_minus_linear(-d / (1.0 - at_mode), (1.0 - x) / (1.0 - at_mode));
    const double value = std::copysign(std::sqrt(2.0 * std::max(fall, 0.0)), d);
    const double total = prior.a + prior.b - 2.0;
    // The limit of total d / (x (1 - x) value) at the mode, where value vanishes with d.
    if (value == 0.0) return {.value = 0.0, .slope = std::sqrt(total / (at_mode * (1.0 - at_mode)))};
    return {.value = value, .slope = total * d / (x * (1.0 - x) * value)};
}

double mode_of(const NormalPrior& prior) {
    return prior.mean;
}

double mode_of(const LogNormalPrior& prior) {
    return prior.median * std::exp(-prior.sigma_log * prior.sigma_log);
}

double mode_of(const BetaPrior& prior) {
    return (prior.a - 1.0) / (prior.a + prior.b - 2.0);
}

double share_below(const NormalPrior& prior, double x) {
    return normal_share_below((x - prior.mean) / prior.sigma);
}

double share_below(const LogNormalPrior& prior, double x) {
    return x > 0.0 ? normal_share_below(std::log(x / prior.median) / prior.sigma_log) : 0.0;
}

double share_below(const BetaPrior& prior, double x) {
    return boost::math::cdf(boost::math::beta_distribution<double>(prior.a, prior.b), std::clamp(x, 0.0, 1.0));
}

double quantile_of(const NormalPrior& prior, double share) {
    return boost::math::quantile(boost::math::normal_distribution<double>(prior.mean, prior.sigma), share);
}

double quantile_of(const LogNormalPrior& prior, double share) {
    return prior.median *
           std::exp(prior.sigma_log * boost::math::quantile(boost::math::normal_distribution<double>(), share));
}

double quantile_of(const BetaPrior& prior, double share) {
    return boost::math::quantile(boost::math::beta_distribution<double>(prior.a, prior.b), share);
}

Bounds support_of(const NormalPrior& /*prior*/) {
    return {-infinite, infinite};
}

Bounds support_of(const LogNormalPrior& prior) {
    return {mode(prior) * std::exp(-farthest_residual * prior.sigma_log), infinite};
}

/// Where the residual of a beta prior has the absolute value `farthest_residual`, between the mode and an `end`.
double farthest(const BetaPrior& prior, double end) {
    const double sign = end == 0.0 ? -1.0 : 1.0;
    // Distance from the end on a logarithmic scale: the density falls like a power of it.
    const auto at = [&](double log_distance) { return std::abs(end - std::exp(log_distance)); };
    const auto excess = [&](double log_distance) {
        return sign * residual_of(prior, at(log_distance)).value - farthest_residual;
    };
    // 700: the smallest distance a double holds. A power so low that even there the residual is less has no limit.
    const double nearest = end == 0.0 ? -700.0 : std::log(std::numeric_limits<double>::epsilon());
    if (excess(nearest) < 0.0) return at(nearest);
    std::uintmax_t steps = 200;
    const auto [below, above] = boost::math::tools::toms748_solve(
        excess, nearest, std::log(std::abs(end - mode(prior))), boost::math::tools::eps_tolerance<double>(30), steps);
    return at(0.5 * (below + above));
}

Bounds support_of(const BetaPrior& prior) {
    return {farthest(prior, 0.0), farthest(prior, 1.0)};
}

}  // namespace

Residual prior_residual(const Prior& prior, double x) {
    return std::visit([x](const auto& kind) { return residual_of(kind, x); }, prior);
}

double mode(const Prior& prior) {
    return std::visit([](const auto& kind) { return mode_of(kind); }, prior);
}

double mass_within(const Prior& prior, const Bounds& bounds) {
    return std::visit(
        [&bounds](const auto& kind) { return share_below(kind, bounds.upper) - share_below(kind, bounds.lower); },
        prior);
}

double standard_deviation(const Prior& prior, const Bounds& bounds) {
    // About the mode, and on either side of it, so that a narrow density is not overlooked.
    const double centre = std::clamp(mode(prior), bounds.lower, bounds.upper);
    const auto moment = [&](int power) {
        const auto weighted = [&](double x) {
            const double residual = prior_residual(prior, x).value;
            return std::pow(x - centre, power) * std::exp(-0.5 * residual * residual);
        };
        constexpr unsigned halvings = 15;
        constexpr double tolerance = 1e-6;  // relative
        double sum = 0.0;
        for (const Bounds& side : {Bounds{bounds.lower, centre}, Bounds{centre, bounds.upper}}) {
            if (side.lower == side.upper) continue;
            sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(weighted, side.lower, side.upper,
                                                                                 halvings, tolerance);
        }
        return sum;
    };
    const double mass = moment(0);
    const double mean = moment(1) / mass;
    return std::sqrt(moment(2) / mass - mean * mean);
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
    const Bounds support = std::visit([](const auto& kind) { return support_of(kind); }, prior);
    const bool lower_has_density = std::isfinite(prior_residual(prior, bounds.lower).value);
    const bool upper_has_density = std::isfinite(prior_residual(prior, bounds.upper).value);
    return {lower_has_density ? bounds.lower : support.lower, upper_has_density ? bounds.upper : support.upper};
}

}  // namespace skinfit
