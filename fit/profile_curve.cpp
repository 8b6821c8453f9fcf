#include "fit/profile_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fit/prior.hpp"

namespace skinfit {
namespace {

/// Two neighbours, how far apart they are in the natural coordinate, and where between them, 0 to 1, something lies.
struct Gap {
    const ProfilePoint& left;
    const ProfilePoint& right;
    double width;
    double share;
};

Gap gap_about(const ProfileCurve& curve, const std::optional<Prior>& prior, double at) {
    assert(!curve.empty());
    const auto right = std::ranges::upper_bound(curve, at, {}, &ProfilePoint::at);
    if (right == curve.begin()) return {curve.front(), curve.front(), 0.0, 0.0};
    if (right == curve.end()) return {curve.back(), curve.back(), 0.0, 0.0};
    const ProfilePoint& left = *(right - 1);
    const double from = natural_coordinate(prior, left.at);
    const double width = natural_coordinate(prior, right->at) - from;
    return {left, *right, width, (natural_coordinate(prior, at) - from) / width};
}

}  // namespace

double cost_rise_at(const ProfileCurve& curve, const std::optional<Prior>& prior, double at) {
    const auto [left, right, width, share] = gap_about(curve, prior, at);
    const double rest = 1.0 - share;
    const double left_slope = left.cost_slope / coordinate_slope(prior, left.at);
    const double right_slope = right.cost_slope / coordinate_slope(prior, right.at);
    // Hermite's cubic.
    const double rise = rest * rest * (1.0 + 2.0 * share) * left.cost_rise +
                        share * share * (1.0 + 2.0 * rest) * right.cost_rise +
                        share * rest * width * (rest * left_slope - share * right_slope);
    return std::max(rise, 0.0);
}

double cost_rise_95_at(const ProfileCurve& curve, const std::optional<Prior>& prior, double at) {
    const Gap gap = gap_about(curve, prior, at);
    return std::lerp(gap.left.cost_rise_95, gap.right.cost_rise_95, gap.share);
}

}  // namespace skinfit
