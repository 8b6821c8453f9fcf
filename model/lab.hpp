#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "model/colour.hpp"

namespace skinfit {

/// CIELAB 1976. [CIE15]
struct Lab {
    double l;  ///< lightness L*, 0 black to 100 white
    double a;  ///< a*, green below zero, red above
    double b;  ///< b*, blue below zero, yellow above
};

/// CIELAB coordinates relative to `white`, whose values are above zero. [CIE15]
[[nodiscard]] Lab lab_from_xyz(const Xyz& xyz, const Xyz& white);

/// The inverse of `lab_from_xyz`.
[[nodiscard]] Xyz xyz_from_lab(const Lab& lab, const Xyz& white);

/// The individual typology angle arctan((L* - 50) / b*) in degrees, -90 to 90. None unless b* is above zero, as that of
/// skin is: on the blue side the angle means nothing. [CHARDON91]
[[nodiscard]] std::optional<double> individual_typology_angle_deg(const Lab& lab);

/// The classes of skin colour by their angle, each above 55, 41, 28, 10 and -30 degrees. [CHARDON91] [DELBINO06]
enum class SkinColour { very_light, light, intermediate, tan, brown, dark };
inline constexpr std::size_t skin_colour_count = 6;

/// The angles above which each class but the last begins, degrees.
inline constexpr std::array<double, skin_colour_count - 1> skin_colour_begins_deg = {55.0, 41.0, 28.0, 10.0, -30.0};

/// The class in which an angle lies.
[[nodiscard]] SkinColour skin_colour(double individual_typology_angle_deg);

/// "very light", "light", "intermediate", "tan", "brown" or "dark".
[[nodiscard]] std::string_view name_of(SkinColour colour);

}  // namespace skinfit
