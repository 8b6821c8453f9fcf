#pragma once

#include <cmath>

#include "model/scattering.hpp"
#include "model/trigonometry.hpp"

/// What a walk may know of a ray's azimuth about the normal. The walk tells each event to its azimuth, which either
/// follows it or, at no cost, ignores it.
namespace skinfit {

/// A change of direction: a polar angle from the ray, and an azimuth about the ray counted from the side on which the
/// normal in the direction of travel lies.
struct Deflection {
    double cosine;         ///< of the polar angle
    double sine;           ///< of the polar angle
    double azimuth_turns;  ///< full turns, 0 to 1
};

/// The cosine to the normal of a ray of cosine `cosine` after `deflection`.
[[nodiscard]] inline double deflected_cosine(double cosine, const Deflection& deflection) {
    return deflected_cosine(cosine, deflection.cosine, deflection.sine, cosine_of_turns(deflection.azimuth_turns));
}

/// For walks that need no azimuth.
struct IgnoredAzimuth {
    static void deflect(double /*cosine*/, const Deflection& /*deflection*/) {}
    template <class DrawTurns>
    static void draw(DrawTurns&& /*draw_turns*/) {}
};

/// The horizontal part of a ray's direction. It begins in the plane of incidence, going forward; reflection and
/// refraction at the plane interfaces leave it as it is.
class FollowedAzimuth {
public:
    /// The ray's azimuth from the forward half plane of incidence, rad, -pi to pi.
    [[nodiscard]] double angle() const { return std::atan2(across_, along_); }

    /// Turns a ray of cosine `cosine` to the normal. Along its old azimuth the new direction has
    /// sin cos_d - cos sin_d cos_a, and sin_d sin_a across it: the deflection in the frame of the ray.
    void deflect(double cosine, const Deflection& deflection) {
        const double sine_squared = 1.0 - cosine * cosine;
        const double sine = std::sqrt(sine_squared > 0.0 ? sine_squared : 0.0);
        const double forward =
            sine * deflection.cosine - cosine * deflection.sine * cosine_of_turns(deflection.azimuth_turns);
        const double sideways = deflection.sine * sine_of_turns(deflection.azimuth_turns);
        const double length = std::sqrt(forward * forward + sideways * sideways);
        if (length == 0.0) return;  // along the normal, where any azimuth is as good
        const double along = (along_ * forward - across_ * sideways) / length;
        across_ = (along_ * sideways + across_ * forward) / length;
        along_ = along;
    }

    /// Takes a new azimuth, of `draw_turns()` full turns.
    template <class DrawTurns>
    void draw(DrawTurns&& draw_turns) {
        const double turns = draw_turns();
        along_ = cosine_of_turns(turns);
        across_ = sine_of_turns(turns);
    }

private:
    double along_ = 1.0;
    double across_ = 0.0;
};

}  // namespace skinfit
