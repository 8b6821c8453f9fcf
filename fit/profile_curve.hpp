#pragma once

#include <optional>
#include <vector>

#include "fit/configuration.hpp"

namespace skinfit {

/// What is known of the profile of one parameter where it was evaluated: the cost minimised over the other parameters.
struct ProfilePoint {
    double at;            ///< the parameter's position in the unit box; in a result its value
    double cost_rise;     ///< of the cost above that of the minimum, 0 or more
    double cost_slope;    ///< derivative of the rise by `at`
    double cost_rise_95;  ///< up to which `at` belongs to the 95 % interval: the square of `critical_root`
};

/// The points of one profile by ascending `at`, the minimum among them.
using ProfileCurve = std::vector<ProfilePoint>;

/// The rise of the cost between the points of `curve`, of which there is at least one, of a parameter with `prior`:
/// cubic in the natural coordinate between two points, whose rises and slopes it meets. `at` is moved to the nearest
/// end where it lies outside.
[[nodiscard]] double cost_rise_at(const ProfileCurve& curve, const std::optional<Prior>& prior, double at);

/// `ProfilePoint::cost_rise_95` between the points, linear in the natural coordinate.
[[nodiscard]] double cost_rise_95_at(const ProfileCurve& curve, const std::optional<Prior>& prior, double at);

}  // namespace skinfit
