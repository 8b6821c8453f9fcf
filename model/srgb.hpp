#pragma once

#include <string>

#include "model/colour.hpp"

namespace skinfit {

/// Red, green and blue of the sRGB primaries, each 0 to 1 where a display can show the colour; linear or encoded.
struct Rgb {
    double r, g, b;
};

/// The white of sRGB, by the matrix of [IEC61966].
[[nodiscard]] Xyz srgb_white();

/// What is seen alike under the white `to` as `xyz` under the white `from`: von Kries' rule on the cone responses of
/// the linear Bradford transform. [ICC03]
[[nodiscard]] Xyz bradford_adapted(const Xyz& xyz, const Xyz& from, const Xyz& to);

/// Linear sRGB of a colour seen with `white`, adapted to the white of sRGB: the perfect diffuser is (1, 1, 1) under
/// every illuminant and for both observers. Nothing is clipped. [IEC61966]
[[nodiscard]] Rgb linear_srgb(const Xyz& xyz, const Xyz& white);

/// The encoded values of linear ones, a power of 1/2.4 above a linear toe [IEC61966]. The toe goes on below zero and
/// the power above one.
[[nodiscard]] Rgb encoded_srgb(const Rgb& linear);

/// Whether a display can show it: every 8-bit code, 255 times the encoded value, rounds to 0 to 255.
[[nodiscard]] bool in_srgb_gamut(const Rgb& encoded);

/// Each of the three cut to 0 to 1. Changes the hue; say so where `in_srgb_gamut` is false.
[[nodiscard]] Rgb clipped_to_srgb_gamut(const Rgb& encoded);

/// The 8-bit codes as "#rrggbb"; asserts that the colour is in gamut.
[[nodiscard]] std::string hex_string(const Rgb& encoded);

}  // namespace skinfit
