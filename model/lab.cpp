#include "model/lab.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/constants.hpp"

namespace skinfit {
namespace {

constexpr double kink = 6.0 / 29.0;

/// The cube root of [CIE15], continued by its tangent below `kink` cubed.
double compressed(double ratio) {
    return ratio > kink * kink * kink ? std::cbrt(ratio) : ratio / (3.0 * kink * kink) + 4.0 / 29.0;
}

double expanded(double root) {
    return root > kink ? root * root * root : 3.0 * kink * kink * (root - 4.0 / 29.0);
}

}  // namespace

Lab lab_from_xyz(const Xyz& xyz, const Xyz& white) {
    const double x = compressed(xyz.x / white.x);
    const double y = compressed(xyz.y / white.y);
    const double z = compressed(xyz.z / white.z);
    return {.l = 116.0 * y - 16.0, .a = 500.0 * (x - y), .b = 200.0 * (y - z)};
}

Xyz xyz_from_lab(const Lab& lab, const Xyz& white) {
    const double y = (lab.l + 16.0) / 116.0;
    return {white.x * expanded(y + lab.a / 500.0), white.y * expanded(y), white.z * expanded(y - lab.b / 200.0)};
}

std::optional<double> individual_typology_angle_deg(const Lab& lab) {
    if (!(lab.b > 0.0)) return std::nullopt;
    return std::atan((lab.l - 50.0) / lab.b) * 180.0 / pi;
}

SkinColour skin_colour(double individual_typology_angle_deg) {
    const auto class_found = std::ranges::find_if(skin_colour_begins_deg,
                                                  [&](double limit) { return individual_typology_angle_deg > limit; });
    return static_cast<SkinColour>(class_found - skin_colour_begins_deg.begin());
}

std::string_view name_of(SkinColour colour) {
    constexpr std::array<std::string_view, 6> names = {"very light", "light", "intermediate", "tan", "brown", "dark"};
    return names.at(static_cast<std::size_t>(colour));
}

}  // namespace skinfit
