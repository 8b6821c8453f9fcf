#include "fit/profile_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fit/profile.hpp"

namespace skinfit {
namespace {

/// Two neighbours and where between them, 0 to 1, something lies.
struct Gap {
    const ProfilePoint& left;
    const ProfilePoint& right;
    double share;
};

Gap gap_about(const ProfileCurve& curve, double at) {
    assert(!curve.empty());
    const auto right = std::ranges::upper_bound(curve, at, {}, &ProfilePoint::at);
    if (right == curve.begin()) return {curve.front(), curve.front(), 0.0};
    if (right == curve.end()) return {curve.back(), curve.back(), 0.0};
    const ProfilePoint& left = *(right - 1);
    return {left, *right, (at - left.at) / (right->at - left.at)};
}

}  // namespace

double cost_rise_at(const ProfileCurve& curve, double at) {
    const auto [left, right, share] = gap_about(curve, at);
    const double rest = 1.0 - share;
    const double width = right.at - left.at;
    // Hermite's cubic.
    const double rise = rest * rest * (1.0 + 2.0 * share) * left.cost_rise +
                        share * share * (1.0 + 2.0 * rest) * right.cost_rise +
                        share * rest * width * (rest * left.cost_slope - share * right.cost_slope);
    return std::max(rise, 0.0);
}

double cost_rise_95(const ProfileCurve& curve, double at, const Bounds& bounds) {
    const auto [left, right, share] = gap_about(curve, at);
    const double sigma = std::lerp(left.sigma, right.sigma, share);
    const double distance = std::max(0.0, std::min(at - bounds.lower, bounds.upper - at));
    const double root = critical_root(distance / sigma);
    return root * root;
}

}  // namespace skinfit
