#include "transport/photon_paths.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "model/constants.hpp"
#include "model/fresnel.hpp"

namespace skinfit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double float_epsilon = std::numeric_limits<float>::epsilon();

/// Two layers with steps of refractive index above, between and below.
TurbidStack two_layers() {
    return {.layers = {{40, 0.7, 1.5, 0.01}, {100, 0.8, 1.4, 0.05}}, .index_above = 1.0, .index_below = 1.3};
}

PhotonMean share(const PhotonPaths& paths, Side side, const PerTurbidLayer& absorption,
                 const Gathering& gathering = {}) {
    return paths.shares(side, {&absorption, 1}, {&gathering, 1})[0][0];
}

TEST(PhotonPaths, WithoutAbsorptionEveryPhotonLeavesOnce) {
    for (const std::optional<double> incidence_rad : {std::optional<double>(0.0), std::optional<double>(1.2), {}}) {
        const PhotonPaths paths = PhotonPaths::trace(two_layers(), {.incidence_rad = incidence_rad, .photons = 5000});
        EXPECT_EQ(paths.escaped(Side::top).count() + paths.escaped(Side::bottom).count(), 5000U);
        EXPECT_EQ(paths.lost(), 0U);
        if (!incidence_rad) continue;  // the surface takes the same from every photon of a beam
        const double sum = share(paths, Side::top, {}).value + share(paths, Side::bottom, {}).value;
        EXPECT_NEAR(sum, 1.0, float_epsilon);
    }
}

TEST(PhotonPaths, AreTheSameOnAnyNumberOfThreads) {
    const PhotonOptions options{.incidence_rad = 0.3, .photons = 10'500, .seed = 4};
    const auto traced = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return PhotonPaths::trace(two_layers(), options);
    };
    const PhotonPaths one = traced(1);
    const PhotonPaths three = traced(3);
    for (const Side side : {Side::top, Side::bottom}) {
        EXPECT_EQ(one.escaped(side).lengths_cm, three.escaped(side).lengths_cm);
        EXPECT_EQ(one.escaped(side).radius_cm, three.escaped(side).radius_cm);
        EXPECT_EQ(one.escaped(side).cosine, three.escaped(side).cosine);
        EXPECT_EQ(one.escaped(side).weight, three.escaped(side).weight);
    }
    EXPECT_NE(one.escaped(Side::top).cosine,
              PhotonPaths::trace(two_layers(), {.incidence_rad = 0.3, .photons = 10'500, .seed = 5})
                  .escaped(Side::top)
                  .cosine);
}

TEST(PhotonPaths, WithoutScatteringAndStepsOfIndexLightDimsAsLambertAndBeerSay) {
    const TurbidStack clear{.layers = {{0, 0, 1.0, 0.02}, {0, 0, 1.0, 0.05}}};
    const PerTurbidLayer absorption{7, 12};
    for (const double incidence_rad : {0.0, 0.5, 1.2}) {
        const PhotonPaths paths = PhotonPaths::trace(clear, {.incidence_rad = incidence_rad, .photons = 100});
        const double depth = (0.02 * 7 + 0.05 * 12) / std::cos(incidence_rad);
        // Lengths and weights are floats.
        EXPECT_NEAR(share(paths, Side::bottom, absorption).value, std::exp(-depth), (1.0 + depth) * float_epsilon);
        EXPECT_EQ(paths.escaped(Side::top).count(), 0U);
    }
}

TEST(PhotonPaths, AClearPlateSendsLightOnWhereSnellSays) {
    const TurbidStack plate{.layers = {{0, 0, 1.5, 0.1}}, .index_above = 1.0, .index_below = 1.2};
    const double incidence_rad = 0.7;
    const double inside = std::asin(std::sin(incidence_rad) / 1.5);
    const double below = std::asin(std::sin(incidence_rad) / 1.2);
    const PhotonPaths paths = PhotonPaths::trace(plate, {.incidence_rad = incidence_rad, .photons = 2000});
    const auto expect_crossings = [&](Side side, double cosine, int first) {
        const EscapedPhotons& photons = paths.escaped(side);
        ASSERT_GT(photons.count(), 0U);
        for (std::size_t i = 0; i < photons.count(); ++i) {
            EXPECT_NEAR(photons.cosine[i], cosine, float_epsilon);
            const double crossings = photons.radius_cm[i] / (0.1 * std::tan(inside));
            EXPECT_NEAR(crossings, 2.0 * std::round((crossings - first) / 2.0) + first, 4 * crossings * float_epsilon);
            EXPECT_NEAR(photons.lengths_cm[0][i], photons.radius_cm[i] / std::sin(inside),
                        4 * photons.lengths_cm[0][i] * float_epsilon);
        }
    };
    expect_crossings(Side::bottom, std::cos(below), 1);
    expect_crossings(Side::top, std::cos(incidence_rad), 2);
}

TEST(PhotonPaths, DeepClearLayersKeepTheirLight) {
    const TurbidStack deep{.layers = {{0, 0, 1.3, infinity}}};
    const PhotonPaths paths = PhotonPaths::trace(deep, {.photons = 100, .least_absorption_per_cm = {1e-9}});
    EXPECT_EQ(paths.lost(), 100U);
    EXPECT_DOUBLE_EQ(share(paths, Side::top, {}).value, FresnelInterface(1.0, 1.3).reflectance(1.0));
    EXPECT_EQ(share(paths, Side::top, {}, {.specular = Specular::excluded}).value, 0.0);
}

TEST(PhotonPaths, DiffuseLightIsReflectedByTheSurfaceAsAveragedFresnel) {
    // The average over the hemisphere for an index of 1.5 is 0.09178, in the closed form of [DUNTLEY42].
    const PhotonPaths paths =
        PhotonPaths::trace({.layers = {{1, 0, 1.5, 0.1}}}, {.incidence_rad = std::nullopt, .photons = 2});
    const double n = 1.5;
    const double n2 = n * n;
    const double walsh = 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                         n2 * std::pow(n2 - 1, 2) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
                         2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n2 * n2 - 1)) +
                         8 * n2 * n2 * (n2 * n2 + 1) / ((n2 + 1) * std::pow(n2 * n2 - 1, 2)) * std::log(n);
    EXPECT_NEAR(paths.surface_share({}), walsh, 1e-7);  // of the midpoint rule of 10'000 points
    // All light within a right angle is all light.
    EXPECT_DOUBLE_EQ(paths.surface_share({.viewing_cone_rad = 0.5 * pi}), paths.surface_share({}));
}

TEST(PortShare, HasItsLimits) {
    const Gathering equal{.spot_radius_cm = 0.4, .port_radius_cm = 0.4};
    EXPECT_DOUBLE_EQ(port_share(equal, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(port_share(equal, 0.8), 0.0);
    // Two circles, each through the other's middle, share 2/3 - sqrt(3)/(2 pi) of their area.
    EXPECT_NEAR(port_share(equal, 0.4), 2.0 / 3.0 - std::numbers::sqrt3 / (2.0 * pi), 1e-15);
    EXPECT_DOUBLE_EQ(port_share({.spot_radius_cm = 0.4, .port_radius_cm = 0.1}, 0.2), 0.0625);
    EXPECT_DOUBLE_EQ(port_share({.spot_radius_cm = 0.1, .port_radius_cm = 0.4}, 0.2), 1.0);
    EXPECT_DOUBLE_EQ(port_share({.port_radius_cm = 0.4}, 0.39), 1.0);
    EXPECT_DOUBLE_EQ(port_share({.port_radius_cm = 0.4}, 0.41), 0.0);
    EXPECT_DOUBLE_EQ(port_share({}, 1e9), 1.0);
}

TEST(PortShare, IsReciprocal) {
    // Light finds its way from the spot to the port as from the port to the spot, per area that is lit.
    for (const double step_cm : {0.05, 0.2, 0.3, 0.45}) {
        EXPECT_NEAR(port_share({.spot_radius_cm = 0.3, .port_radius_cm = 0.2}, step_cm) * 0.09,
                    port_share({.spot_radius_cm = 0.2, .port_radius_cm = 0.3}, step_cm) * 0.04, 1e-15);
    }
}

}  // namespace
}  // namespace skinfit
