#include "model/fresnel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "model/random.hpp"

namespace skinfit {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Indices {
    double n1;
    double n2;
};

class Fresnel : public testing::TestWithParam<Indices> {};

TEST_P(Fresnel, NormalIncidenceHasItsClosedForm) {
    const auto [n1, n2] = GetParam();
    const double amplitude = (n1 - n2) / (n1 + n2);
    EXPECT_DOUBLE_EQ(FresnelInterface(n1, n2).reflectance(1.0), amplitude * amplitude);
    EXPECT_DOUBLE_EQ(FresnelInterface(n1, n2).transmitted_cosine(1.0), 1.0);
}

TEST_P(Fresnel, GrazingLightIsReflected) {
    // 1 - R = 4 cosine (...) near grazing: at cosine 1e-12 it is below 1e-10 for indices up to 2.
    EXPECT_NEAR(FresnelInterface(GetParam().n1, GetParam().n2).reflectance(1e-12), 1.0, 1e-10);
}

TEST_P(Fresnel, SnellHoldsOnBothSides) {
    const auto [n1, n2] = GetParam();
    const FresnelInterface interface(n1, n2);
    for (int i = 1; i <= 100; ++i) {
        const double cosine = 0.01 * i;
        const double sine2 = n1 / n2 * std::sqrt(1.0 - cosine * cosine);
        const double transmitted = interface.transmitted_cosine(cosine);
        // Squares of sines are at most 1 here, each with a handful of roundings.
        if (transmitted == 0.0) {
            EXPECT_GE(sine2, 1.0 - 8 * epsilon);
        } else {
            EXPECT_NEAR(1.0 - transmitted * transmitted, sine2 * sine2, 8 * epsilon);
        }
    }
}

TEST_P(Fresnel, ReflectedAndTransmittedPowerSumToOne) {
    const auto [n1, n2] = GetParam();
    const FresnelInterface interface(n1, n2);
    for (int i = 1; i <= 100; ++i) {
        const double c1 = 0.01 * i;
        const double c2 = interface.transmitted_cosine(c1);
        if (c2 == 0.0) continue;
        const double perpendicular = 2.0 * n1 * c1 / (n1 * c1 + n2 * c2);
        const double parallel = 2.0 * n1 * c1 / (n2 * c1 + n1 * c2);
        const double transmittance = n2 * c2 / (n1 * c1) * 0.5 * (perpendicular * perpendicular + parallel * parallel);
        // Both sides use the same c2, so only about 16 roundings of terms below 1 remain.
        EXPECT_NEAR(interface.reflectance(c1) + transmittance, 1.0, 16 * epsilon);
    }
}

TEST_P(Fresnel, IsReciprocal) {
    const auto [n1, n2] = GetParam();
    for (int i = 10; i <= 100; ++i) {
        const double c1 = 0.01 * i;
        const double c2 = FresnelInterface(n1, n2).transmitted_cosine(c1);
        if (c2 < 0.1) continue;
        // The way back finds c1 within a few epsilon / c, and dR/dc is at most 2 |r| n1 c1 n2 c2 / sum^2 / c <= 2 / c.
        const double smallest = std::min(c1, c2);
        EXPECT_NEAR(FresnelInterface(n2, n1).reflectance(c2), FresnelInterface(n1, n2).reflectance(c1),
                    16 * epsilon / (smallest * smallest));
    }
}

TEST_P(Fresnel, BrewsterLightIsReflectedInOnePolarisationOnly) {
    const auto [n1, n2] = GetParam();
    const double brewster_cosine = n1 / std::hypot(n1, n2);
    const double amplitude = (n1 * n1 - n2 * n2) / (n1 * n1 + n2 * n2);
    EXPECT_NEAR(FresnelInterface(n1, n2).reflectance(brewster_cosine), 0.5 * amplitude * amplitude, 16 * epsilon);
}

TEST_P(Fresnel, EverythingIsReflectedBeyondTheCriticalAngleAlone) {
    const auto [n1, n2] = GetParam();
    const FresnelInterface interface(n1, n2);
    const double sine = n2 / n1;
    const double critical_cosine = sine < 1.0 ? std::sqrt(1.0 - sine * sine) : 0.0;
    for (int i = 1; i < 1000; ++i) {
        const double cosine = 0.001 * i;
        EXPECT_EQ(interface.reflectance(cosine) == 1.0, cosine < critical_cosine) << cosine;
        EXPECT_EQ(interface.transmitted_cosine(cosine) == 0.0, cosine < critical_cosine) << cosine;
    }
}

TEST_P(Fresnel, ReflectsIsTheComparisonWithTheReflectance) {
    const FresnelInterface interface(GetParam().n1, GetParam().n2);
    int compared = 0;
    for (std::uint64_t ray = 0; ray < 100'000; ++ray) {
        const FourUniforms xi = RandomRay(1, ray).uniforms(0, 0);
        const double transmitted = interface.transmitted_cosine(xi[1]);
        if (transmitted == 0.0) continue;  // the walk does not ask then
        const double reflectance = interface.reflectance(xi[1]);
        // Half of the numbers lie close to the reflectance, where a mistake would show.
        const double tested = xi[2] < 0.5 ? xi[0] : reflectance * (1.0 + 1e-6 * (xi[0] - 0.5));
        if (std::abs(tested - reflectance) <= 32 * epsilon * reflectance) continue;  // some 20 roundings apart
        EXPECT_EQ(interface.reflects(tested, xi[1], transmitted), tested < reflectance);
        ++compared;
    }
    EXPECT_GT(compared, 10'000);
}

INSTANTIATE_TEST_SUITE_P(IndexPairs, Fresnel,
                         testing::Values(Indices{1.0, 1.55}, Indices{1.55, 1.0}, Indices{1.55, 1.40},
                                         Indices{1.40, 1.36}, Indices{1.36, 1.38}, Indices{1.40, 1.0},
                                         Indices{1.0, 2.0}, Indices{2.0, 1.0}));

TEST(FresnelMatched, NothingIsReflected) {
    const FresnelInterface interface(1.38, 1.38);
    for (int i = 1; i <= 100; ++i) {
        const double cosine = 0.01 * i;
        // The transmitted cosine is within 2 epsilon / cosine; the amplitudes are half its relative error.
        const double amplitude = 2 * epsilon / (cosine * cosine);
        EXPECT_LE(interface.reflectance(cosine), amplitude * amplitude);
        EXPECT_NEAR(interface.transmitted_cosine(cosine), cosine, 2 * epsilon / cosine);
    }
}

}  // namespace
}  // namespace skinfit
