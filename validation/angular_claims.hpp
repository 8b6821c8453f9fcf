#pragma once

#include <span>

#include "validation/curve.hpp"
#include "validation/finding.hpp"

/// Claims about where light leaves: pure functions of computed curves, whose standard errors are known.
namespace skinfit {

/// Differences of this many standard errors count: less than one in a million is so large by chance.
inline constexpr double decisive_z = 5.0;

/// A ratio and its standard error.
struct Ratio {
    double value;
    double standard_error;
};

/// How directional a curve is: the BRDF in the step that holds the mirror direction, in the plane of incidence, over
/// the mean of the hemisphere. 1 for a Lambertian surface.
[[nodiscard]] Ratio directionality(const AngularCurve& curve);

/// The directionality grows from every curve, two at least, to the next, by `decisive_z` standard errors or more.
[[nodiscard]] ClaimFinding more_directional_in_order(std::span<const AngularCurve> curves);

/// Up to 60 degrees from the normal, every curve, one at least, departs from its mean by no more than 10 %: its rings
/// one by one, and its plane of incidence in parts of about 20 degrees, forward and backward. Beyond lies a quarter of
/// a Lambertian's light. The limit is a convention: about what practical diffusers, which are called Lambertian,
/// depart.
[[nodiscard]] ClaimFinding near_lambertian(std::span<const AngularCurve> curves);

}  // namespace skinfit
