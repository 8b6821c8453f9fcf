#include "model/goniophotometer.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/input_error.hpp"
#include "model/band.hpp"
#include "model/constants.hpp"
#include "model/reciprocity.hpp"
#include "model/table.hpp"

namespace skinfit {
namespace {

std::uint64_t sum(const std::vector<std::uint64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

Incidence at_deg(double polar_deg) {
    return {polar_deg * rad_per_deg, polar_deg * rad_per_deg};
}

TEST(Goniophotometer, RaysEndAsInTheWalkWithoutAzimuthsAndNoneIsLost) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        for (const int layers : {2, 4}) {
            for (const Base& base :
                 {Base{Base::Kind::hypodermis}, Base{Base::Kind::matched}, Base{Base::Kind::index, 1.44}}) {
                const Sample sample{.skin = {}, .edition = edition, .layers = layers, .base = base};
                for (const double incidence_deg : {0.0, 45.0, 89.0}) {
                    const AngularCounts counts = goniophotometer(
                        sample, {540}, {.incidence = at_deg(incidence_deg), .rays = 5000, .seed = 3, .bins = {}})[0];
                    const WalkCounts walked = random_walk(
                        sample, {540}, {.incidence_rad = incidence_deg * rad_per_deg, .rays = 5000, .seed = 3})[0];
                    EXPECT_EQ(counts.totals, walked);
                    EXPECT_EQ(sum(counts.surface), walked.surface_reflected);
                    EXPECT_EQ(sum(counts.subsurface), walked.subsurface_reflected);
                    EXPECT_EQ(sum(counts.transmitted), walked.transmitted);
                    EXPECT_EQ(sum(counts.surface) + sum(counts.subsurface) + sum(counts.transmitted) +
                                  std::accumulate(walked.absorbed.begin(), walked.absorbed.end(), std::uint64_t{0}),
                              5000U);
                }
            }
        }
    }
}

TEST(Goniophotometer, CountsDoNotDependOnThreads) {
    const Sample sample{.skin = {}, .base = {Base::Kind::matched}};
    const GoniophotometerOptions options{.incidence = {0.2, 0.4}, .rays = 50'500, .seed = 4, .bins = {}};
    const auto counts_with = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return goniophotometer(sample, {450, 660}, options);
    };
    EXPECT_EQ(counts_with(1), counts_with(2));
}

TEST(Goniophotometer, WavelengthsFollowDifferentRays) {
    GoniophotometerOptions options{.incidence = at_deg(30), .rays = 5000, .bins = {}};
    const std::vector<AngularCounts> both = goniophotometer({}, {450, 660}, options);
    options.first_ray = 5000;
    EXPECT_EQ(both[1], goniophotometer({}, {660}, options)[0]);
    options.first_ray = 0;
    EXPECT_NE(both[1], goniophotometer({}, {660}, options)[0]);
}

// Rounding of an expression of a few operations and elementary functions, each good to a few units in the last place.
constexpr double few_roundings = 16 * std::numeric_limits<double>::epsilon();

TEST(Goniophotometer, BrdfOverTheHemisphereIsTheReflectanceCounted) {
    for (const AngularBins& bins : {AngularBins{}, AngularBins{.polar = 1, .azimuth = 2}, AngularBins{90, 72}}) {
        const Sample sample{.skin = {}, .base = {Base::Kind::matched}};
        const AngularSpectrum spectrum{
            .bins = bins,
            .counts = goniophotometer(sample, {450, 660}, {.incidence = at_deg(45), .rays = 20'000, .bins = bins}),
            .weights = {2.0, 6.0}};
        const auto integral = [&](Light light) {
            double total = 0.0;
            for (int polar = 0; polar < bins.polar; ++polar) {
                for (int azimuth = 0; azimuth < bins.azimuth; ++azimuth) {
                    total += brdf(spectrum, light, polar, azimuth).per_sr * bins.projected_solid_angle(polar);
                }
            }
            return total;
        };
        const auto counted = [&](auto&& of) {
            return (0.25 * static_cast<double>(of(spectrum.counts[0].totals)) +
                    0.75 * static_cast<double>(of(spectrum.counts[1].totals))) /
                   20'000;
        };
        // One rounding of the running sum per bin.
        const double bound = few_roundings + static_cast<double>(bins.count()) * std::numeric_limits<double>::epsilon();
        EXPECT_NEAR(integral(Light::surface), counted([](const WalkCounts& c) { return c.surface_reflected; }), bound);
        EXPECT_NEAR(integral(Light::subsurface), counted([](const WalkCounts& c) { return c.subsurface_reflected; }),
                    bound);
        EXPECT_NEAR(integral(Light::transmitted), counted([](const WalkCounts& c) { return c.transmitted; }), bound);
        EXPECT_NEAR(integral(Light::reflected), integral(Light::surface) + integral(Light::subsurface), 2 * bound);
    }
}

TEST(Goniophotometer, RingIsTheMeanOfItsBins) {
    const AngularSpectrum spectrum{
        .bins = {},
        .counts = goniophotometer({}, {600}, {.incidence = at_deg(45), .rays = 20'000, .bins = {}}),
        .weights = {1.0}};
    for (int polar = 0; polar < 18; ++polar) {
        double mean = 0.0;
        for (int azimuth = 0; azimuth < 36; ++azimuth) {
            mean += brdf(spectrum, Light::reflected, polar, azimuth).per_sr / 36;
        }
        const BrdfValue ring = brdf(spectrum, Light::reflected, polar);
        EXPECT_NEAR(ring.per_sr, mean, 36 * few_roundings * mean);
        // A count's binomial error, [p (1 - p) / N]^1/2, in units of the ring's projected solid angle.
        const double solid_angle = 36 * spectrum.bins.projected_solid_angle(polar);
        const double share = ring.per_sr * solid_angle;
        EXPECT_NEAR(ring.standard_error * solid_angle, std::sqrt(share * (1 - share) / 20'000), few_roundings);
    }
}

TEST(Goniophotometer, BinsHoldTheDirectionsTheySay) {
    const AngularBins bins;
    const auto bin = [&](double polar_deg, double azimuth_deg) {
        return bins.index(std::cos(polar_deg * rad_per_deg), azimuth_deg * rad_per_deg);
    };
    EXPECT_EQ(bin(0, 0), 0U);
    EXPECT_EQ(bin(4.99, 4.99), 0U);
    EXPECT_EQ(bin(5.01, -4.99), 36U);
    EXPECT_EQ(bin(2, 5.01), 1U);
    EXPECT_EQ(bin(2, -5.01), 35U);
    EXPECT_EQ(bin(2, 180), 18U);
    EXPECT_EQ(bin(2, -180), 18U);
    EXPECT_EQ(bin(90, -180), bins.count() - 36 + 18);
    double hemisphere = 0.0;
    for (int polar = 0; polar < bins.polar; ++polar) {
        EXPECT_NEAR(bins.polar_edge_rad(polar), 5 * polar * rad_per_deg, few_roundings);
        hemisphere += bins.azimuth * bins.projected_solid_angle(polar);
    }
    EXPECT_NEAR(hemisphere, pi, 18 * few_roundings * pi);
}

TEST(Goniophotometer, WhereNoRayIsCountedTheErrorIsWhatOneRayCounts) {
    const AngularBins bins;
    AngularSpectrum spectrum{.bins = bins, .counts = {AngularCounts(bins), AngularCounts(bins)}, .weights = {1.0, 3.0}};
    for (AngularCounts& counts : spectrum.counts) counts.totals.rays = 1000;
    const BrdfValue none = brdf(spectrum, Light::subsurface, 4, 7);
    EXPECT_EQ(none.per_sr, 0.0);
    EXPECT_DOUBLE_EQ(none.standard_error, 0.75 / 1000 / bins.projected_solid_angle(4));
    spectrum.counts[1].subsurface[bins.index(std::cos(22.5 * rad_per_deg), 0.0)] = 1;
    const BrdfValue one = brdf(spectrum, Light::subsurface, 4, 0);
    EXPECT_DOUBLE_EQ(one.per_sr, none.standard_error);
    EXPECT_NEAR(one.standard_error, none.standard_error, none.standard_error / 1000);
}

TEST(Goniophotometer, FlatSkinIsAMirror) {
    // Trowbridge-Reitz: the share warped by less than psi is tan^2 psi / (sigma^2 + tan^2 psi). About 42.5 degrees a
    // cone of 2.5 degrees lies within the bin, so at most 1 - share of the rays miss it; at the smallest sigma, 0.001,
    // that is 5.2e-4. Ten times as many would be a chance far below 1e-6.
    Sample sample;
    sample.skin.fold_aspect_ratio = 0.001;
    const AngularBins bins;
    const AngularCounts counts =
        goniophotometer(sample, {550}, {.incidence = at_deg(42.5), .rays = 100'000, .bins = {}})[0];
    const std::uint64_t mirrored = counts.surface[bins.index(std::cos(42.5 * rad_per_deg), 0.0)];
    const std::uint64_t missed = counts.totals.surface_reflected - mirrored;
    const double tangent = std::tan(2.5 * rad_per_deg);
    const double expected = static_cast<double>(counts.totals.surface_reflected) * 1e-6 / (1e-6 + tangent * tangent);
    EXPECT_GT(counts.totals.surface_reflected, 4000U);
    EXPECT_LE(static_cast<double>(missed), std::ceil(10 * expected));
}

TEST(Band, WeightsAreTheTables) {
    EXPECT_EQ(band_weights({400, 700}, BandIlluminant::equal_energy), (std::vector<double>{1, 1}));
    EXPECT_EQ(band_weights({560}, BandIlluminant::d65), std::vector<double>{100});
    const std::vector<double>& v = embedded_table("cie_observers").column("y2");
    const std::vector<double>& nm = embedded_table("cie_observers").columns[0];
    for (std::size_t i = 0; nm[i] <= 780; ++i) {  // where D65 ends
        EXPECT_EQ(band_weights({nm[i]}, BandIlluminant::d65_v)[0],
                  band_weights({nm[i]}, BandIlluminant::d65)[0] * v[i]);
    }
    EXPECT_THROW((void)band_weights({2000}, BandIlluminant::d65), InputError);
}

TEST(Reciprocity, ComparesEveryTwoBinsBothWays) {
    const std::vector<ReciprocityPair> pairs =
        compare_both_ways({}, {550}, {1.0}, Light::reflected, {2, 6, 10}, {.incidence = {}, .rays = 5000, .bins = {}});
    ASSERT_EQ(pairs.size(), 9U);
    EXPECT_EQ(pairs[0].azimuth_bin, std::nullopt);
    EXPECT_EQ(pairs[1].azimuth_bin, 0);
    EXPECT_EQ(pairs[2].azimuth_bin, 18);
    EXPECT_EQ(pairs[8].polar_bin_a, 6);
    EXPECT_EQ(pairs[8].polar_bin_b, 10);
    for (const ReciprocityPair& pair : pairs) {
        const double error = std::hypot(pair.a_to_b.standard_error, pair.b_to_a.standard_error);
        EXPECT_NEAR(pair.z * error, pair.a_to_b.per_sr - pair.b_to_a.per_sr, few_roundings);
    }
}

}  // namespace
}  // namespace skinfit
