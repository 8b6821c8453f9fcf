#include "model/srgb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skinfit {
namespace {

struct Triple {
    double x, y, z;
};

/// A 3 by 3 matrix by its columns.
struct Matrix {
    Triple first, second, third;
};

/// XYZ, white at Y = 1, of the red, green and blue primary. [IEC61966]
constexpr Matrix srgb_primaries = {{0.4124, 0.2126, 0.0193}, {0.3576, 0.7152, 0.1192}, {0.1805, 0.0722, 0.9505}};

/// Cone responses to X, Y and Z. [ICC03]
constexpr Matrix bradford = {{0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296}};

Triple product(const Matrix& m, const Triple& v) {
    return {m.first.x * v.x + m.second.x * v.y + m.third.x * v.z, m.first.y * v.x + m.second.y * v.y + m.third.y * v.z,
            m.first.z * v.x + m.second.z * v.y + m.third.z * v.z};
}

double determinant(const Triple& a, const Triple& b, const Triple& c) {
    return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
}

/// The vector whose product with `m` is `v`, by Cramer's rule.
Triple solution(const Matrix& m, const Triple& v) {
    const double all = determinant(m.first, m.second, m.third);
    return {determinant(v, m.second, m.third) / all, determinant(m.first, v, m.third) / all,
            determinant(m.first, m.second, v) / all};
}

Triple cone_responses(const Xyz& xyz) {
    return product(bradford, {xyz.x, xyz.y, xyz.z});
}

double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double code(double encoded) {
    return std::round(255.0 * encoded);
}

}  // namespace

Xyz srgb_white() {
    const Triple white = product(srgb_primaries, {100.0, 100.0, 100.0});
    return {white.x, white.y, white.z};
}

Xyz bradford_adapted(const Xyz& xyz, const Xyz& from, const Xyz& to) {
    const Triple seen = cone_responses(xyz);
    const Triple before = cone_responses(from);
    const Triple after = cone_responses(to);
    const Triple adapted = solution(
        bradford, {seen.x * (after.x / before.x), seen.y * (after.y / before.y), seen.z * (after.z / before.z)});
    return {adapted.x, adapted.y, adapted.z};
}

Rgb linear_srgb(const Xyz& xyz, const Xyz& white) {
    const Xyz adapted = bradford_adapted(xyz, white, srgb_white());
    const Triple rgb = solution(srgb_primaries, {adapted.x / 100.0, adapted.y / 100.0, adapted.z / 100.0});
    return {rgb.x, rgb.y, rgb.z};
}

Rgb encoded_srgb(const Rgb& linear) {
    return {encoded(linear.r), encoded(linear.g), encoded(linear.b)};
}

bool in_srgb_gamut(const Rgb& encoded) {
    const auto fits = [](double value) { return code(value) >= 0.0 && code(value) <= 255.0; };
    return fits(encoded.r) && fits(encoded.g) && fits(encoded.b);
}

Rgb clipped_to_srgb_gamut(const Rgb& encoded) {
    return {std::clamp(encoded.r, 0.0, 1.0), std::clamp(encoded.g, 0.0, 1.0), std::clamp(encoded.b, 0.0, 1.0)};
}

std::string hex_string(const Rgb& encoded) {
    assert(in_srgb_gamut(encoded));
    const auto byte = [](double value) { return static_cast<int>(code(value)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(encoded.r), byte(encoded.g), byte(encoded.b));
}

}  // namespace skinfit
