#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "model/constants.hpp"
#include "model/goniophotometer.hpp"
#include "tests/model/obvious_walk.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

constexpr AngularBins bins{.polar = 9, .azimuth = 12};
constexpr std::uint64_t obvious_rays = 150'000;
constexpr double wavelength_nm = 600;

/// Light skin on a base that transmits, so that every way out is taken.
Sample light_skin(Edition edition) {
    Sample sample{.skin = {}, .edition = edition, .base = {Base::Kind::index, 1.44}};
    sample.skin.melanosome_fraction = 0.01;
    return sample;
}

/// The same counts from the plain walk, whose directions are vectors in space.
AngularCounts obvious_counts(const Sample& sample, double incidence_rad) {
    AngularCounts counts(bins);
    const std::array<std::vector<std::uint64_t>*, 3> ways_out = {&counts.surface, &counts.subsurface,
                                                                 &counts.transmitted};
    (void)test::obvious_walk(
        {.sample = sample,
         .wavelength_nm = wavelength_nm,
         .incidence_rad = incidence_rad,
         .rays = obvious_rays,
         .seed = 77,
         .rule = sample.edition == Edition::printed ? test::RayleighRule::until_bounced : test::RayleighRule::downward,
         .on_exit = [&](const test::ObviousExit& exit) {
             const double horizontal = std::hypot(exit.x, exit.y);
             const double polar_deg = std::atan2(horizontal, std::abs(exit.z)) * 180 / pi;
             const double azimuth_deg = std::atan2(exit.y, exit.x) * 180 / pi + 360 + 15;  // bins are centred on 0
             const auto polar_bin = static_cast<std::size_t>(polar_deg / 10);
             const auto azimuth_bin = static_cast<std::size_t>(azimuth_deg / 30) % 12;
             ++(*ways_out[static_cast<std::size_t>(exit.way_out)])[std::min<std::size_t>(polar_bin, 8) * 12 +
                                                                   azimuth_bin];
         }});
    return counts;
}

/// A z for every bin that holds enough rays for a nearly normal count.
void append_z(const std::vector<std::uint64_t>& a, std::uint64_t a_rays, const std::vector<std::uint64_t>& b,
              std::vector<double>& z) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] + b[i] < 50) continue;
        z.push_back(test::z_between(test::Count{a[i], a_rays}, test::Count{b[i], obvious_rays}));
    }
}

double p_value(const Sample& walked, const Sample& obvious, double incidence_deg) {
    constexpr std::uint64_t rays = 1'000'000;
    const double incidence_rad = incidence_deg * rad_per_deg;
    const AngularCounts fast =
        goniophotometer(walked, {wavelength_nm},
                        {.incidence = {incidence_rad, incidence_rad}, .rays = rays, .seed = 8, .bins = bins})[0];
    const AngularCounts plain = obvious_counts(obvious, incidence_rad);
    std::vector<double> z;
    append_z(fast.surface, rays, plain.surface, z);
    append_z(fast.subsurface, rays, plain.subsurface, z);
    append_z(fast.transmitted, rays, plain.transmitted, z);
    EXPECT_GT(z.size(), 200U);
    return test::family_wise_p_value(z);
}

TEST(GoniophotometerAgainstObviousWalk, EveryDirectionIsAsProbable) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        const Sample sample = light_skin(edition);
        for (const double incidence_deg : {30.0, 70.0}) {
            EXPECT_GT(p_value(sample, sample, incidence_deg), test::passing_p_value) << incidence_deg;
        }
    }
}

TEST(GoniophotometerAgainstObviousWalk, SeparatedLayersInAirKeepTheAzimuthOfTransmittedLight) {
    const Sample sample{.skin = {}, .layers = 2, .base = {Base::Kind::index, 1.0}};
    EXPECT_GT(p_value(sample, sample, 60), test::passing_p_value);
}

TEST(GoniophotometerAgainstObviousWalk, FoldsTwentyPercentSteeperAreSeen) {
    const Sample sample = light_skin(Edition::revised);
    Sample steeper = sample;
    steeper.skin.fold_aspect_ratio *= 1.2;
    EXPECT_LT(p_value(sample, steeper, 70), test::passing_p_value);
}

TEST(GoniophotometerAgainstObviousWalk, FiveDegreesOfIncidenceAreSeenInTransmittedLight) {
    const Sample sample{.skin = {}, .layers = 2, .base = {Base::Kind::index, 1.0}};
    const AngularCounts plain = obvious_counts(sample, 65 * rad_per_deg);
    const double incidence_rad = 60 * rad_per_deg;
    const AngularCounts fast =
        goniophotometer(sample, {wavelength_nm},
                        {.incidence = {incidence_rad, incidence_rad}, .rays = 500'000, .seed = 8, .bins = bins})[0];
    std::vector<double> z;
    append_z(fast.transmitted, 500'000, plain.transmitted, z);
    EXPECT_LT(test::family_wise_p_value(z), test::passing_p_value);
}

}  // namespace
}  // namespace skinfit
