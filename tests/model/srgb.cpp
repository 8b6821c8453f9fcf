#include "model/srgb.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace skinfit {
namespace {

/// Two systems of three equations and a product, fewer than 200 roundings of half an epsilon, amplified at most by the
/// condition numbers of the two matrices (4 for cones, 6 for primaries, in the norm of the largest row sum).
constexpr double rounding = 100 * std::numeric_limits<double>::epsilon() * 4 * 6;

void expect_rgb(const Rgb& found, const Rgb& expected, double bound) {
    EXPECT_NEAR(found.r, expected.r, bound);
    EXPECT_NEAR(found.g, expected.g, bound);
    EXPECT_NEAR(found.b, expected.b, bound);
}

std::string hex_of_linear(const Rgb& linear) {
    return hex_string(encoded_srgb(linear));
}

TEST(Srgb, PrimariesAreTheStandards) {
    // [IEC61966] gives XYZ of each primary.
    expect_rgb(linear_srgb({41.24, 21.26, 1.93}, srgb_white()), {1, 0, 0}, rounding);
    expect_rgb(linear_srgb({35.76, 71.52, 11.92}, srgb_white()), {0, 1, 0}, rounding);
    expect_rgb(linear_srgb({18.05, 7.22, 95.05}, srgb_white()), {0, 0, 1}, rounding);
}

TEST(Srgb, InverseIsThatOfTheAmendment) {
    // Seven decimals in the amendment of [IEC61966].
    expect_rgb(linear_srgb({100, 0, 0}, srgb_white()), {3.2406255, -0.9689307, 0.0557101}, 5e-8);
    expect_rgb(linear_srgb({0, 100, 0}, srgb_white()), {-1.5372080, 1.8757561, -0.2040211}, 5e-8);
    expect_rgb(linear_srgb({0, 0, 100}, srgb_white()), {-0.4986286, 0.0415175, 1.0569959}, 5e-8);
}

TEST(Srgb, FlatSpectraAreGreyHoweverSeen) {
    for (const Illuminant illuminant : {Illuminant::d65, Illuminant::equal_energy}) {
        for (const Observer observer : {Observer::two_degrees, Observer::ten_degrees}) {
            for (const double grey : {0.0, 0.2, 0.5, 1.0}) {
                const SeenColour seen = colour_of({.wavelength_nm = {400, 700}, .value = {grey, grey}},
                                                  {.illuminant = illuminant, .observer = observer});
                const Rgb linear = linear_srgb(seen.xyz, seen.white);
                expect_rgb(linear, {grey, grey, grey}, rounding);
                EXPECT_TRUE(in_srgb_gamut(encoded_srgb(linear)));
            }
        }
    }
}

TEST(Srgb, WhiteIsThatOfD65) {
    // The standard's matrix has four decimals: its rows sum to the white of x = 0.3127, y = 0.3290 within three halves
    // of the last.
    EXPECT_NEAR(srgb_white().x, 100.0 * 0.3127 / 0.3290, 0.015);
    EXPECT_NEAR(srgb_white().y, 100.0, 1e-12);
    EXPECT_NEAR(srgb_white().z, 100.0 * 0.3583 / 0.3290, 0.015);
}

TEST(Srgb, AdaptationIsThatOfTheTechnicalNote) {
    // [ICC03] prints the matrix from D65 to D50 to 15 digits; its columns are what becomes of unit X, Y and Z.
    constexpr Xyz d65{95.04, 100.0, 108.89};
    constexpr Xyz d50{96.42, 100.0, 82.49};
    const auto expect_column = [&](const Xyz& unit, const Xyz& column) {
        const Xyz adapted = bradford_adapted(unit, d65, d50);
        EXPECT_NEAR(adapted.x, column.x, rounding);
        EXPECT_NEAR(adapted.y, column.y, rounding);
        EXPECT_NEAR(adapted.z, column.z, rounding);
    };
    expect_column({1, 0, 0}, {1.04790738171017, 0.0296059594177168, -0.00924679432678241});
    expect_column({0, 1, 0}, {0.0229333845542104, 0.990456039910785, 0.0150626801401488});
    expect_column({0, 0, 1}, {-0.0502016347980104, -0.01707552919587, 0.751791232609078});
}

TEST(Srgb, AdaptationTakesWhiteToWhiteAndBack) {
    const Xyz from = white({Illuminant::equal_energy, Observer::two_degrees});
    const Xyz to = white({Illuminant::d65, Observer::ten_degrees});
    const Xyz adapted = bradford_adapted(from, from, to);
    EXPECT_NEAR(adapted.x, to.x, 100 * rounding);
    EXPECT_NEAR(adapted.y, to.y, 100 * rounding);
    EXPECT_NEAR(adapted.z, to.z, 100 * rounding);
    const Xyz back = bradford_adapted(bradford_adapted({30, 20, 10}, from, to), to, from);
    EXPECT_NEAR(back.x, 30, 100 * rounding);
    EXPECT_NEAR(back.y, 20, 100 * rounding);
    EXPECT_NEAR(back.z, 10, 100 * rounding);
}

TEST(Srgb, EncodingInvertsTheDisplay) {
    // The display's law, [IEC61966]: (v + 0.055) / 1.055 to the power of 2.4 above 0.04045, v / 12.92 below. The
    // encoding divides the roundings of that power by 2.4 and adds a few of its own, of numbers of at most 1.055.
    for (int code = 0; code <= 255; ++code) {
        const double shown = code / 255.0;
        const double linear = shown > 0.04045 ? std::pow((shown + 0.055) / 1.055, 2.4) : shown / 12.92;
        const Rgb encoded = encoded_srgb({linear, linear, linear});
        ASSERT_NEAR(encoded.r, shown, 10 * std::numeric_limits<double>::epsilon());
        ASSERT_EQ(encoded.g, encoded.r);
        ASSERT_EQ(encoded.b, encoded.r);
    }
}

TEST(Srgb, EncodingIsContinuousAndGoesOnBeyondItsRange) {
    const auto encoded = [](double linear) { return encoded_srgb({linear, 0, 0}).r; };
    // The two branches meet as well as the two decimals of 12.92 allow: half the last, at the kink.
    EXPECT_NEAR(encoded(std::nextafter(0.0031308, 1.0)), encoded(0.0031308), 0.005 * 0.0031308);
    EXPECT_DOUBLE_EQ(encoded(0.0031308), 12.92 * 0.0031308);
    EXPECT_DOUBLE_EQ(encoded(0.0031309), 1.055 * std::pow(0.0031309, 1.0 / 2.4) - 0.055);
    EXPECT_EQ(encoded(-0.5), -0.5 * 12.92);
    EXPECT_GT(encoded(1.5), 1.0);
}

TEST(Srgb, HexIsTheRoundedCode) {
    EXPECT_EQ(hex_of_linear({0, 0, 0}), "#000000");
    EXPECT_EQ(hex_of_linear({1, 1, 1}), "#ffffff");
    EXPECT_EQ(hex_of_linear({1, 0, 0}), "#ff0000");
    EXPECT_EQ(hex_of_linear({0, 1, 0}), "#00ff00");
    EXPECT_EQ(hex_of_linear({0, 0, 1}), "#0000ff");
    EXPECT_EQ(hex_of_linear({0.5, 0.5, 0.5}), "#bcbcbc");  // 255 * 0.73536 = 187.5
    EXPECT_EQ(hex_string({0.49 / 255, 0.51 / 255, 254.51 / 255}), "#0001ff");
}

TEST(Srgb, GamutEndsWhereTheCodeDoes) {
    EXPECT_TRUE(in_srgb_gamut({-0.49 / 255, 0.5, 255.49 / 255}));
    EXPECT_EQ(hex_string({-0.49 / 255, 0.5, 255.49 / 255}), "#0080ff");
    EXPECT_FALSE(in_srgb_gamut({-0.51 / 255, 0.5, 0.5}));
    EXPECT_FALSE(in_srgb_gamut({0.5, 255.51 / 255, 0.5}));
    EXPECT_FALSE(in_srgb_gamut({0.5, 0.5, std::nan("")}));
    const Rgb clipped = clipped_to_srgb_gamut({-0.3, 0.4, 1.2});
    EXPECT_EQ(clipped.r, 0.0);
    EXPECT_EQ(clipped.g, 0.4);
    EXPECT_EQ(clipped.b, 1.0);
}

TEST(Srgb, OneWavelengthIsOutOfGamut) {
    // No display primary lies on the spectrum locus, and green light of 520 nm is far outside their triangle.
    const SeenColour seen = colour_of({.wavelength_nm = {380, 515, 520, 525, 780}, .value = {0, 0, 1, 0, 0}}, {});
    const Rgb encoded = encoded_srgb(linear_srgb(seen.xyz, seen.white));
    EXPECT_LT(encoded.r, 0.0);
    EXPECT_FALSE(in_srgb_gamut(encoded));
    EXPECT_TRUE(in_srgb_gamut(clipped_to_srgb_gamut(encoded)));
}

}  // namespace
}  // namespace skinfit
