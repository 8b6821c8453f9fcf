#include "model/spectrophotometer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace skinfit {
namespace {

/// Skin from which nothing returns: an optical depth of hundreds in the stratum corneum alone.
Experiment black_skin() {
    Experiment experiment;
    experiment.incidence_rad = 1.2;
    experiment.values.skin.stratum_corneum_thickness_cm = 1.0;
    experiment.values.skin.stratum_corneum_carotene_g_per_l = 1.0;
    experiment.specular = Specular::excluded;
    experiment.values.instrument = {.scale = 1.25, .offset = 0.01};
    return experiment;
}

TEST(ReadByWalk, OfBlackSkinCountsAShareOfTheRaysThatTheSurfaceReflects) {
    constexpr std::uint64_t rays = 20'000;
    constexpr double few_roundings = 1e-14;
    for (const double fraction : {0.0, 0.25, 0.5, 1.0}) {
        Experiment experiment = black_skin();
        experiment.values.instrument.specular_fraction = fraction;
        const Reading reading = read_by_walk(experiment, {450}, rays, 3).front();
        const double surface = reading.surface_reflectance;
        ASSERT_GT(surface, 0.1);
        EXPECT_NEAR(reading.reflectance, 1.25 * fraction * surface + 0.01, few_roundings);
        // A share of a binomial count scatters by that share of its scatter.
        const double scatter = std::sqrt(surface * (1.0 - surface) / static_cast<double>(rays - 1));
        const double of_one_ray = 1.0 / rays;  // where none is counted
        EXPECT_NEAR(reading.reflectance_se, 1.25 * (fraction > 0.0 ? fraction * scatter : of_one_ray), few_roundings);
        EXPECT_EQ(reading.transmittance, 0.01);
        EXPECT_EQ(reading.transmittance_se, 0.0);
    }
}

TEST(ReadByWalk, WhereNoRayIsCountedTheErrorIsWhatOneRayCounts) {
    constexpr std::uint64_t rays = 20'000;
    Experiment experiment = black_skin();
    experiment.values.instrument = {.specular_fraction = 0.0};
    experiment.base = {Base::Kind::matched};
    const Reading reading = read_by_walk(experiment, {450}, rays, 3).front();
    EXPECT_EQ(reading.reflectance, 0.0);
    EXPECT_DOUBLE_EQ(reading.reflectance_se, 1.0 / rays);
    EXPECT_EQ(reading.transmittance, 0.0);
    EXPECT_DOUBLE_EQ(reading.transmittance_se, 1.0 / rays);
    experiment.viewing_cone_rad = 0.1;
    const double sine = std::sin(0.1);
    EXPECT_DOUBLE_EQ(read_by_walk(experiment, {450}, rays, 3).front().reflectance_se, 1.0 / (rays * sine * sine));
    experiment.base = {Base::Kind::hypodermis};  // nothing can go through
    EXPECT_EQ(read_by_walk(experiment, {450}, rays, 3).front().transmittance_se, 0.0);
}

TEST(Readings, ScaleAndOffsetOfTheInstrumentActOnThemAndTheScaleOnTheirErrors) {
    const std::vector<double> wavelengths_nm = {450, 600};
    Experiment plain;
    plain.base = {Base::Kind::matched};
    Experiment scaled = plain;
    scaled.values.instrument.scale = 2.0;  // a power of two: the product is exact
    scaled.values.instrument.offset = 0.125;
    const PathEnsemble ensemble =
        PathEnsemble::trace(plain.sample(), wavelengths_nm, {.incidence_rad = plain.incidence_rad, .rays = 3200});
    const auto engines = {
        std::function([&](const Experiment& experiment) { return read_by_walk(experiment, wavelengths_nm, 2000, 3); }),
        std::function(
            [&](const Experiment& experiment) { return read_by_paths(experiment, wavelengths_nm, ensemble); }),
        std::function([&](const Experiment& experiment) { return read_by_solver(experiment, wavelengths_nm); })};
    for (const auto& read : engines) {
        const std::vector<Reading> before = read(plain);
        const std::vector<Reading> after = read(scaled);
        for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
            EXPECT_EQ(after[i].reflectance, 2.0 * before[i].reflectance + 0.125);
            EXPECT_EQ(after[i].transmittance, 2.0 * before[i].transmittance + 0.125);
            EXPECT_EQ(after[i].reflectance_se, 2.0 * before[i].reflectance_se);
            EXPECT_EQ(after[i].transmittance_se, 2.0 * before[i].transmittance_se);
            EXPECT_EQ(after[i].surface_reflectance, before[i].surface_reflectance);
        }
    }
}

}  // namespace
}  // namespace skinfit
