#include "model/colour_difference.hpp"

#include <cmath>

#include "model/constants.hpp"

namespace skinfit {
namespace {

constexpr double radians(double degrees) {
    return degrees * rad_per_deg;
}

/// Chroma and hue with the a* axis stretched near grey, [SHARMA05, Eqs. 5-7].
struct Stretched {
    double chroma;
    double hue_rad;  ///< 0 to 2 pi; 0 for a grey
};

Stretched stretched(const Lab& lab, double stretch) {
    const double a = stretch * lab.a;
    if (a == 0.0 && lab.b == 0.0) return {.chroma = 0.0, .hue_rad = 0.0};
    const double hue = std::atan2(lab.b, a);
    return {.chroma = std::hypot(a, lab.b), .hue_rad = hue < 0.0 ? hue + 2.0 * pi : hue};
}

/// sqrt(C^7 / (C^7 + 25^7)): 0 at grey, 1 far from it.
double saturation(double chroma) {
    const double power = std::pow(chroma, 7);
    return std::sqrt(power / (power + 6103515625.0));
}

/// From the first hue to the second on the shorter way, [SHARMA05, Eq. 10].
double hue_change(const Stretched& first, const Stretched& second) {
    if (first.chroma * second.chroma == 0.0) return 0.0;
    const double change = second.hue_rad - first.hue_rad;
    if (change > pi) return change - 2.0 * pi;
    if (change < -pi) return change + 2.0 * pi;
    return change;
}

/// Half way between the hues on the shorter way; that of the other where one is a grey, [SHARMA05, Eq. 14].
double mean_hue(const Stretched& first, const Stretched& second) {
    const double sum = first.hue_rad + second.hue_rad;
    if (first.chroma * second.chroma == 0.0) return sum;
    if (std::abs(first.hue_rad - second.hue_rad) <= pi) return 0.5 * sum;
    return sum < 2.0 * pi ? 0.5 * sum + pi : 0.5 * sum - pi;
}

double squared(double value) {
    return value * value;
}

}  // namespace

double ciede2000(const Lab& first, const Lab& second) {
    const double mean_plain_chroma = 0.5 * (std::hypot(first.a, first.b) + std::hypot(second.a, second.b));
    const double stretch = 1.0 + 0.5 * (1.0 - saturation(mean_plain_chroma));
    const Stretched from = stretched(first, stretch);
    const Stretched to = stretched(second, stretch);

    const double chroma = 0.5 * (from.chroma + to.chroma);
    const double hue = mean_hue(from, to);
    const double from_middle = squared(0.5 * (first.l + second.l) - 50.0);

    // [SHARMA05, Eqs. 15-21]
    const double hue_weight = 1.0 - 0.17 * std::cos(hue - radians(30.0)) + 0.24 * std::cos(2.0 * hue) +
                              0.32 * std::cos(3.0 * hue + radians(6.0)) - 0.20 * std::cos(4.0 * hue - radians(63.0));
    const double lightness_scale = 1.0 + 0.015 * from_middle / std::sqrt(20.0 + from_middle);
    const double chroma_scale = 1.0 + 0.045 * chroma;
    const double hue_scale = 1.0 + 0.015 * chroma * hue_weight;
    const double turn = radians(30.0) * std::exp(-squared((hue - radians(275.0)) / radians(25.0)));
    const double rotation = -std::sin(2.0 * turn) * 2.0 * saturation(chroma);

    // [SHARMA05, Eqs. 8-11, 22]
    const double lightness_change = (second.l - first.l) / lightness_scale;
    const double chroma_change = (to.chroma - from.chroma) / chroma_scale;
    const double hue_arc = 2.0 * std::sqrt(from.chroma * to.chroma) * std::sin(0.5 * hue_change(from, to)) / hue_scale;
    return std::sqrt(squared(lightness_change) + squared(chroma_change) + squared(hue_arc) +
                     rotation * chroma_change * hue_arc);
}

}  // namespace skinfit
