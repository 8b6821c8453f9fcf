#include "model/azimuth.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "model/random.hpp"

namespace skinfit {
namespace {

using Vector = std::array<double, 3>;

Vector direction(double cosine, const FollowedAzimuth& azimuth) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {sine * std::cos(azimuth.angle()), sine * std::sin(azimuth.angle()), cosine};
}

double dot(const Vector& a, const Vector& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double triple_product(const Vector& a, const Vector& b, const Vector& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

TEST(FollowedAzimuth, DeflectedDirectionsLieAtTheStatedAngles) {
    // The series for sine and cosine, each within 2e-10, enter the new cosine, the two horizontal parts and through the
    // square roots the components divided by the smaller of two sines, all kept above 0.01 here.
    constexpr double bound = 4 * 2e-10 / (0.01 * 0.01);
    const RandomRay random(5, 6);
    int tested = 0;
    for (std::uint32_t event = 0; event < 10'000; ++event) {
        const FourUniforms xi = random.uniforms(event, 0);
        FollowedAzimuth azimuth;
        azimuth.draw([&] { return xi[0]; });
        const double cosine = 0.9999 * xi[1];
        const double polar = pi * xi[2];
        const Deflection deflection{.cosine = std::cos(polar), .sine = std::sin(polar), .azimuth_turns = xi[3]};
        const Vector before = direction(cosine, azimuth);
        azimuth.deflect(cosine, deflection);
        const double next = deflected_cosine(cosine, deflection);
        if (std::abs(next) > 0.9999) continue;
        ++tested;
        const Vector after = direction(next, azimuth);
        EXPECT_NEAR(dot(before, after), deflection.cosine, bound);
        const Vector normal = {0, 0, 1};
        EXPECT_NEAR(triple_product(normal, before, after),
                    std::sqrt(1 - cosine * cosine) * deflection.sine * std::sin(2 * pi * xi[3]), bound);
    }
    EXPECT_GT(tested, 9000);
}

TEST(FollowedAzimuth, AlongTheNormalItIsTheDeflectionsOwn) {
    for (const double turns : {0.1, 0.3, 0.6, 0.9}) {
        FollowedAzimuth azimuth;
        azimuth.deflect(1.0, {.cosine = 0.5, .sine = std::sqrt(0.75), .azimuth_turns = turns});
        EXPECT_NEAR(std::cos(azimuth.angle()), -std::cos(2 * pi * turns), 1e-9);  // towards the normal, and past it
        EXPECT_NEAR(std::sin(azimuth.angle()), std::sin(2 * pi * turns), 1e-9);
    }
}

TEST(FollowedAzimuth, BeginsForwardAndStaysWithoutDeflection) {
    FollowedAzimuth azimuth;
    EXPECT_EQ(azimuth.angle(), 0.0);
    azimuth.deflect(0.3, {.cosine = 1.0, .sine = 0.0, .azimuth_turns = 0.4});
    EXPECT_EQ(azimuth.angle(), 0.0);
    azimuth.deflect(1.0, {.cosine = 1.0, .sine = 0.0, .azimuth_turns = 0.4});  // vertical before and after
    EXPECT_EQ(azimuth.angle(), 0.0);
}

}  // namespace
}  // namespace skinfit
