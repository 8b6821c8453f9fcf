#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/box_misfit.hpp"
#include "fit/minimum.hpp"
#include "fit/profile_curve.hpp"

namespace skinfit {

/// The interval of one parameter from its profile: the cost as a function of this parameter, minimised over the others.
struct ProfileInterval {
    double lower;  ///< positions in the unit box; in a result values
    double upper;
    bool open_below;  ///< the profile stays below its threshold down to the lower bound
    bool open_above;
    ProfileCurve curve;  ///< where the search evaluated the profile, the minimum and the bounds it reached among them
    /// Whether it excludes no value within the bounds.
    [[nodiscard]] bool is_everything() const { return open_below && open_above; }
};

/// The 95 % intervals of all free parameters.
struct Profile {
    std::vector<ProfileInterval> intervals;  ///< in the order of the free parameters
    Eigen::VectorXd minimum;                 ///< the best position known in the end; in a result the values
    double cost;                             ///< there
    bool better_minimum;                     ///< profiling met a lower cost than that of the given minimum
    int evaluations;
};

/// The rise of the cost, as its root, up to which a value belongs to the 95 % interval when it lies `distance` standard
/// deviations inside its nearest bound: the likelihood ratio of a normal measurement whose mean is known not to lie
/// beyond the bound exceeds the square of this in 5 % of all repetitions, so that intervals cover at any distance
/// [FELDMAN98]. It is 1.645 at the bound, where the ratio is zero half of the time, and 1.960 from that distance on.
[[nodiscard]] double critical_root(double distance);

/// Profiles every position of `misfit` from its minimum over the unit box: an end lies where the cost has risen by the
/// square of `critical_root`, or at the bound. Roots are found by Newton's method on the square root of the rise, whose
/// slope is exact, each point starting from the linearised path of the others; a few evaluations per end. Where a lower
/// cost than that of `minimum` is met, everything starts again from there. A profile that leaves and returns counts as
/// never having left when it is below its threshold at the bound.
[[nodiscard]] Profile profile_intervals(const BoxMisfit& misfit, const Eigen::VectorXd& minimum);

}  // namespace skinfit
