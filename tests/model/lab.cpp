#include "model/lab.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace skinfit {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::array<double, 3> values(const Xyz& xyz) {
    return {xyz.x, xyz.y, xyz.z};
}

TEST(Lab, PerfectDiffuserIsWhiteToTheLastBit) {
    for (const Illuminant illuminant : {Illuminant::d65, Illuminant::equal_energy}) {
        for (const Observer observer : {Observer::two_degrees, Observer::ten_degrees}) {
            const SeenColour seen = colour_of({.wavelength_nm = {383.7, 555.5, 771.1}, .value = {1, 1, 1}},
                                              {.illuminant = illuminant, .observer = observer});
            const Lab lab = lab_from_xyz(seen.xyz, seen.white);
            EXPECT_EQ(lab.l, 100.0);
            EXPECT_EQ(lab.a, 0.0);
            EXPECT_EQ(lab.b, 0.0);
        }
    }
}

TEST(Lab, GreysHaveLightnessOnly) {
    // L* = 116 Y^(1/3) - 16 above the kink; 903.3 Y below, exactly (29/3)^3 Y. Y = 1/8 and 1/64 have exact roots, and
    // L* then has the roundings of a product and a sum below 100.
    const Xyz paper = white({});
    const auto grey = [&](double y) { return lab_from_xyz({y * paper.x, y * paper.y, y * paper.z}, paper); };
    EXPECT_NEAR(grey(0.125).l, 42.0, 100 * epsilon);
    EXPECT_NEAR(grey(0.015625).l, 13.0, 100 * epsilon);
    EXPECT_NEAR(grey(0.001).l, std::pow(29.0 / 3.0, 3) * 0.001, 100 * epsilon);
    EXPECT_NEAR(grey(0.0).l, 0.0, 100 * epsilon);
    for (const double y : {0.0, 0.001, 0.008856, 0.0089, 0.2, 0.9}) {
        // Two functions of equal arguments but for their rounding, times 500.
        EXPECT_NEAR(grey(y).a, 0.0, 500 * 4 * epsilon);
        EXPECT_NEAR(grey(y).b, 0.0, 500 * 4 * epsilon);
    }
}

TEST(Lab, IsThatOfAnIndependentProgram) {
    // colour-science 0.4, white x = 0.3127, y = 0.3290; eight decimals printed.
    const Xyz paper{.x = 100.0 * 0.3127 / 0.3290, .y = 100.0, .z = 100.0 * (1.0 - 0.3127 - 0.3290) / 0.3290};
    const Lab lab = lab_from_xyz({20.654008, 12.197225, 5.136952}, paper);
    EXPECT_NEAR(lab.l, 41.52787529, 5e-9);
    EXPECT_NEAR(lab.a, 52.63858304, 5e-9);
    EXPECT_NEAR(lab.b, 26.92317922, 5e-9);
}

TEST(Lab, ThereAndBackIsTheSameColour) {
    // A root of at most 1.1 off by a few roundings, times 116, 500 or 200 and divided again, then cubed: below 16
    // roundings of the root, tripled, at 109 and 1.1 squared.
    constexpr double bound = 16 * 3 * 109 * 1.21 * epsilon / 2;
    const Xyz paper = white({});
    constexpr int steps = 16;
    for (int i = 0; i < (steps + 1) * (steps + 1) * (steps + 1); ++i) {
        const auto share = [&](int place) { return static_cast<double>(i / place % (steps + 1)) / steps; };
        const Xyz xyz{share(1) * paper.x, share(steps + 1) * paper.y, share((steps + 1) * (steps + 1)) * paper.z};
        const Xyz back = xyz_from_lab(lab_from_xyz(xyz, paper), paper);
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(values(back)[k], values(xyz)[k], bound);
    }
}

TEST(IndividualTypologyAngle, HasItsClosedForms) {
    const double root3 = std::numbers::sqrt3;
    EXPECT_DOUBLE_EQ(individual_typology_angle_deg({.l = 50, .a = 9, .b = 16}).value(), 0.0);
    EXPECT_DOUBLE_EQ(individual_typology_angle_deg({.l = 66, .a = 9, .b = 16}).value(), 45.0);
    EXPECT_DOUBLE_EQ(individual_typology_angle_deg({.l = 34, .a = 9, .b = 16}).value(), -45.0);
    EXPECT_DOUBLE_EQ(individual_typology_angle_deg({.l = 66, .a = 9, .b = 16 * root3}).value(), 30.0);
    EXPECT_DOUBLE_EQ(individual_typology_angle_deg({.l = 66, .a = 9, .b = 16 / root3}).value(), 60.0);
}

TEST(IndividualTypologyAngle, IsNoneOnTheBlueSide) {
    for (const double b : {0.0, -1e-300, -16.0, std::nan("")}) {
        EXPECT_FALSE(individual_typology_angle_deg({.l = 66, .a = 9, .b = b}).has_value()) << b;
    }
}

TEST(IndividualTypologyAngle, ClassesBeginAboveTheirLimits) {
    using enum SkinColour;
    const std::array limits = {55.0, 41.0, 28.0, 10.0, -30.0};
    const std::array classes = {very_light, light, intermediate, tan, brown, dark};
    for (std::size_t i = 0; i < limits.size(); ++i) {
        EXPECT_EQ(skin_colour(std::nextafter(limits[i], 90.0)), classes[i]);
        EXPECT_EQ(skin_colour(limits[i]), classes[i + 1]);
    }
    EXPECT_EQ(skin_colour(90.0), very_light);
    EXPECT_EQ(skin_colour(-90.0), dark);
    EXPECT_EQ(name_of(very_light), "very light");
    EXPECT_EQ(name_of(dark), "dark");
}

}  // namespace
}  // namespace skinfit
