#include <gtest/gtest.h>

#include <cmath>

#include "model/constants.hpp"
#include "model/goniophotometer.hpp"
#include "model/reciprocity.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

constexpr std::size_t polar_bins = 18;
constexpr std::size_t azimuth_bins = 36;

Sample transmitting(Edition edition) {
    Sample sample{.skin = {}, .edition = edition, .base = {Base::Kind::matched}};
    sample.skin.melanosome_fraction = 0.01;
    return sample;
}

AngularCounts counts_at(const Sample& sample, double incidence_deg, std::uint64_t rays = 1'000'000) {
    const double incidence_rad = incidence_deg * rad_per_deg;
    return goniophotometer(sample, {600},
                           {.incidence = {incidence_rad, incidence_rad}, .rays = rays, .seed = 21, .bins = {}})[0];
}

std::uint64_t rays_at(const std::vector<std::uint64_t>& counts, std::size_t polar, std::size_t azimuth) {
    return counts[polar * azimuth_bins + azimuth % azimuth_bins];
}

double azimuth_uniformity(const std::vector<std::uint64_t>& counts) {
    std::vector<std::uint64_t> by_azimuth(azimuth_bins);
    for (std::size_t i = 0; i < counts.size(); ++i) by_azimuth[i % azimuth_bins] += counts[i];
    return test::equal_bins_p_value(by_azimuth);
}

TEST(GoniophotometerLaws, NormalIncidenceHasNoPreferredAzimuth) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        const AngularCounts counts = counts_at(transmitting(edition), 0);
        EXPECT_GT(azimuth_uniformity(counts.surface), test::passing_p_value);
        EXPECT_GT(azimuth_uniformity(counts.subsurface), test::passing_p_value);
        EXPECT_GT(azimuth_uniformity(counts.transmitted), test::passing_p_value);
        const AngularCounts tilted = counts_at(transmitting(edition), 5);
        EXPECT_LT(azimuth_uniformity(tilted.surface), test::passing_p_value) << "5 degrees pass";
    }
}

/// Pearson's test that bins at azimuths phi and -phi about azimuth bin `axis` are equally probable.
double mirror_symmetry(const std::vector<std::uint64_t>& counts, std::size_t axis) {
    constexpr std::uint64_t enough = 20;  // for the square of a count's excess to be nearly chi-square
    double statistic = 0.0;
    double pairs = 0.0;
    for (std::size_t polar = 0; polar < polar_bins; ++polar) {
        for (std::size_t azimuth = 1; azimuth < azimuth_bins / 2; ++azimuth) {
            const std::uint64_t left = rays_at(counts, polar, axis + azimuth);
            const std::uint64_t right = rays_at(counts, polar, axis + azimuth_bins - azimuth);
            if (left + right < enough) continue;
            const double difference = static_cast<double>(left) - static_cast<double>(right);
            statistic += difference * difference / static_cast<double>(left + right);
            pairs += 1.0;
        }
    }
    return test::chi_square_p_value(statistic, pairs);
}

TEST(GoniophotometerLaws, PlaneOfIncidenceIsAPlaneOfSymmetry) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        const AngularCounts counts = counts_at(transmitting(edition), 60);
        EXPECT_GT(mirror_symmetry(counts.surface, 0), test::passing_p_value);
        EXPECT_GT(mirror_symmetry(counts.subsurface, 0), test::passing_p_value);
        EXPECT_GT(mirror_symmetry(counts.transmitted, 0), test::passing_p_value);
        EXPECT_LT(mirror_symmetry(counts.surface, 1), test::passing_p_value) << "a plane 10 degrees off passes";
    }
}

/// At normal incidence a surface reflection leaves under the angle of the fold warp itself: z of every ring.
std::vector<double> warp_z(const AngularCounts& counts, const FoldWarp& warp) {
    const AngularBins bins;
    std::vector<double> z;
    for (std::size_t polar = 0; polar < polar_bins; ++polar) {
        std::uint64_t ring = 0;
        for (std::size_t azimuth = 0; azimuth < azimuth_bins; ++azimuth)
            ring += rays_at(counts.surface, polar, azimuth);
        const double within = warp.share_below(std::cos(bins.polar_edge_rad(static_cast<int>(polar))));
        const double beyond = warp.share_below(std::cos(bins.polar_edge_rad(static_cast<int>(polar) + 1)));
        const double share = within - beyond;
        const auto n = static_cast<double>(counts.totals.surface_reflected);
        z.push_back((static_cast<double>(ring) - n * share) / std::sqrt(n * share * (1.0 - share)));
    }
    return z;
}

TEST(GoniophotometerLaws, SurfaceReflectionAtNormalIncidenceIsTheFoldWarp) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        for (const double ratio : {0.1, 0.5, 1.0}) {
            Sample sample = transmitting(edition);
            sample.skin.fold_aspect_ratio = ratio;
            const AngularCounts counts = counts_at(sample, 0);
            EXPECT_GT(test::family_wise_p_value(warp_z(counts, FoldWarp(edition, ratio))), test::passing_p_value);
            EXPECT_LT(test::family_wise_p_value(warp_z(counts, FoldWarp(edition, 0.95 * ratio))), test::passing_p_value)
                << "a ratio 5 % too low passes";
        }
    }
}

/// The surface's reflectance averaged over a range of incidence: evenly over the `power`-th power of the sine.
double mean_reflectance(const Incidence& range, double power) {
    const FresnelInterface surface(1.0, Skin{}.stratum_corneum_refractive_index);
    const double lowest = std::pow(std::sin(range.lowest_rad), power);
    const double highest = std::pow(std::sin(range.highest_rad), power);
    constexpr int steps = 10'000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double sine = std::pow(std::lerp(lowest, highest, (i + 0.5) / steps), 1.0 / power);
        sum += surface.reflectance(std::sqrt(1.0 - sine * sine));
    }
    return sum / steps;
}

TEST(GoniophotometerLaws, ARangeOfIncidenceIsFilledEvenlyByProjectedSolidAngle) {
    constexpr std::uint64_t rays = 1'000'000;
    Sample sample;
    sample.skin.stratum_corneum_thickness_cm = 1.0;  // black, for speed: what enters is absorbed
    sample.skin.stratum_corneum_carotene_g_per_l = 1.0;
    std::vector<double> z;
    std::vector<double> z_of_sines;
    for (const Incidence& range : {Incidence{0.0, 1.5}, Incidence{0.9, 1.4}, Incidence{1.2, 1.3}}) {
        const WalkCounts totals =
            goniophotometer(sample, {450}, {.incidence = range, .rays = rays, .seed = 22, .bins = {}})[0].totals;
        const test::Estimate found = test::share_of(totals.surface_reflected, rays);
        z.push_back((found.value - mean_reflectance(range, 2.0)) / found.standard_error);
        z_of_sines.push_back((found.value - mean_reflectance(range, 1.0)) / found.standard_error);
    }
    EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value);
    EXPECT_LT(test::family_wise_p_value(z_of_sines), test::passing_p_value) << "even in the sine passes";
}

TEST(GoniophotometerLaws, StandardErrorIsTheScatterOverSeeds) {
    // The sum of squares over se^2 of s independent runs is chi-square with s - 1 degrees of freedom; a ring of two
    // wavelengths of different weights.
    constexpr int runs = 400;
    std::vector<BrdfValue> values;
    for (int run = 0; run < runs; ++run) {
        const AngularSpectrum spectrum{
            .bins = {},
            .counts = goniophotometer(
                {}, {500, 650},
                {.incidence = {0.5, 0.5}, .rays = 3000, .seed = static_cast<std::uint64_t>(run), .bins = {}}),
            .weights = {3.0, 1.0}};
        values.push_back(brdf(spectrum, Light::reflected, 8));
    }
    double mean = 0.0;
    double mean_variance = 0.0;
    for (const BrdfValue& value : values) {
        mean += value.per_sr / runs;
        mean_variance += value.standard_error * value.standard_error / runs;
    }
    double squares = 0.0;
    for (const BrdfValue& value : values) squares += (value.per_sr - mean) * (value.per_sr - mean);
    const auto p = [&](double variance) {
        const double above = test::chi_square_p_value(squares / variance, runs - 1);
        return 2 * std::min(above, 1 - above);
    };
    EXPECT_GT(p(mean_variance), test::passing_p_value);
    EXPECT_LT(p(mean_variance * 1.4 * 1.4), test::passing_p_value) << "an error 40 % too large passes";
    EXPECT_LT(p(mean_variance / 1.4 / 1.4), test::passing_p_value) << "an error 40 % too small passes";
}

std::vector<double> departures(const Sample& sample) {
    std::vector<double> z;
    for (const ReciprocityPair& pair : compare_both_ways(sample, {600}, {1.0}, Light::subsurface, {2, 9, 14},
                                                         {.incidence = {}, .rays = 500'000, .seed = 2, .bins = {}})) {
        z.push_back(pair.z);
    }
    return z;
}

TEST(GoniophotometerLaws, DepartureFromReciprocityIsSeen) {
    EXPECT_LT(test::family_wise_p_value(departures(transmitting(Edition::revised))), test::passing_p_value);
}

}  // namespace
}  // namespace skinfit
