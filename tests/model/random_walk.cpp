#include "model/random_walk.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>

#include "model/chromophores.hpp"
#include "model/table.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

std::vector<Sample> all_kinds_of_samples() {
    std::vector<Sample> samples;
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        for (const int layers : {2, 4}) {
            for (const Base& base : {Base{Base::Kind::hypodermis}, Base{Base::Kind::matched},
                                     Base{Base::Kind::index, 1.0}, Base{Base::Kind::index, 1.44}}) {
                samples.push_back({.skin = {}, .edition = edition, .layers = layers, .base = base});
            }
        }
    }
    return samples;
}

TEST(RandomWalk, EveryRayEndsOnceInEverySample) {
    for (const Sample& sample : all_kinds_of_samples()) {
        for (const double incidence_deg : {0.0, 45.0, 89.0}) {
            const WalkOptions options{.incidence_rad = incidence_deg * rad_per_deg, .rays = 5000};
            for (const WalkCounts& counts : random_walk(sample, {420, 660}, options)) {
                EXPECT_EQ(counts.rays, options.rays);
                EXPECT_EQ(counts.surface_reflected + counts.subsurface_reflected + counts.transmitted +
                              std::accumulate(counts.absorbed.begin(), counts.absorbed.end(), std::uint64_t{0}),
                          options.rays);
                const bool closed = sample.base.kind == Base::Kind::hypodermis;
                EXPECT_TRUE(!closed || counts.transmitted == 0);
                EXPECT_TRUE(sample.layers == 4 || counts.absorbed[2] + counts.absorbed[3] == 0);
            }
        }
    }
}

TEST(RandomWalk, CountsDependNeitherOnThreadsNorOnTheCompanyOfWavelengths) {
    const Sample sample{.skin = {}, .base = {Base::Kind::matched}};
    const WalkOptions options{.incidence_rad = 0.3, .rays = 10'500, .seed = 4};
    std::vector<WalkCounts> one_thread;
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        one_thread = random_walk(sample, {450, 540, 660}, options);
    }
    std::vector<WalkCounts> two_threads;
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
        two_threads = random_walk(sample, {450, 540, 660}, options);
    }
    EXPECT_EQ(one_thread, two_threads);
    const std::vector<WalkCounts> other_order = random_walk(sample, {660, 450}, options);
    EXPECT_EQ(other_order[0], one_thread[2]);
    EXPECT_EQ(other_order[1], one_thread[0]);
}

TEST(RandomWalk, SeedsDiffer) {
    const std::vector<WalkCounts> a = random_walk({}, {540}, {.rays = 10'000, .seed = 1});
    const std::vector<WalkCounts> b = random_walk({}, {540}, {.rays = 10'000, .seed = 2});
    EXPECT_NE(a, b);
}

TEST(RandomWalk, MoreRaysContinueTheSameRays) {
    const WalkCounts few = random_walk({}, {540}, {.rays = 3000})[0];
    const WalkCounts many = random_walk({}, {540}, {.rays = 9000})[0];
    EXPECT_LE(few.surface_reflected, many.surface_reflected);
    EXPECT_LE(few.subsurface_reflected, many.subsurface_reflected);
    EXPECT_LE(many.subsurface_reflected - few.subsurface_reflected, 6000U);
}

TEST(RandomWalk, SurfaceReflectanceIsFresnels) {
    std::vector<double> z;
    for (const double incidence_deg : {0.0, 30.0, 60.0, 85.0}) {
        const WalkOptions options{.incidence_rad = incidence_deg * rad_per_deg, .rays = 200'000};
        const WalkCounts counts = random_walk({}, {500}, options)[0];
        const double expected = FresnelInterface(1.0, 1.55).reflectance(std::cos(options.incidence_rad));
        const auto n = static_cast<double>(options.rays);
        z.push_back((static_cast<double>(counts.surface_reflected) / n - expected) /
                    std::sqrt(expected * (1.0 - expected) / n));
    }
    EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value);
}

TEST(RandomWalk, SurfaceDoesNotSeeTheWavelength) {
    const std::vector<WalkCounts> spectrum = random_walk({}, {400, 700}, {.rays = 10'000});
    EXPECT_EQ(spectrum[0].surface_reflected, spectrum[1].surface_reflected);
}

/// Quadrature over the measured angles of one forward layer: midpoints of `parts` parts of each table interval.
struct AngleNode {
    double cosine;
    double sine;
    double weight;
};

std::vector<AngleNode> angle_nodes(const char* column_name, int parts) {
    const Table& table = embedded_table("forward_scattering");
    const std::vector<double>& degrees = table.column("polar_angle_deg");
    const std::vector<double>& percent = table.column(column_name);
    std::vector<AngleNode> nodes;
    for (std::size_t i = 0; i + 1 < degrees.size(); ++i) {
        for (int k = 0; k < parts; ++k) {
            const double angle = (degrees[i] + (degrees[i + 1] - degrees[i]) * (k + 0.5) / parts) * rad_per_deg;
            nodes.push_back({std::cos(angle), std::sin(angle), (percent[i + 1] - percent[i]) / 100 / parts});
        }
    }
    return nodes;
}

/// The transmittance at normal incidence of stratum corneum and epidermis without any reflection:
/// E[exp(-depth_1 / c_1 - depth_2 / c_2)] over the two scattering events, the second given that it goes on downwards.
double unreflected_transmittance(double depth1, double depth2, int parts) {
    const std::vector<AngleNode> second = angle_nodes("epidermis_546_nm", parts);
    const int azimuths = 16 * parts;
    double total = 0.0;
    for (const AngleNode& first : angle_nodes("stratum_corneum_546_nm", parts)) {
        double through = 0.0;
        double forward = 0.0;
        for (const AngleNode& node : second) {
            for (int k = 0; k < azimuths; ++k) {
                const double azimuth = pi * (k + 0.5) / azimuths;
                const double cosine = first.cosine * node.cosine + first.sine * node.sine * std::cos(azimuth);
                if (cosine <= 0.0) continue;
                through += node.weight * std::exp(-depth2 / cosine);
                forward += node.weight;
            }
        }
        total += first.weight * std::exp(-depth1 / first.cosine) * through / forward;
    }
    return total;
}

Sample without_reflections() {
    Sample sample{.skin = {}, .layers = 2, .base = {Base::Kind::index, 1.0}};
    sample.skin.stratum_corneum_refractive_index = 1.0;
    sample.skin.epidermis_refractive_index = 1.0;
    sample.skin.stratum_corneum_thickness_cm = 0.5;  // for an optical depth that matters
    return sample;
}

TEST(RandomWalk, WithoutReflectionsTransmittanceIsAnIntegral) {
    const Sample sample = without_reflections();
    const PerLayer<double> depth = optical_depth(sample.skin, Extinction::at(546, sample.edition));
    const double coarse = unreflected_transmittance(depth[0], depth[1], 4);
    const double fine = unreflected_transmittance(depth[0], depth[1], 8);
    const WalkCounts counts = random_walk(sample, {546}, {.rays = 1'000'000})[0];
    EXPECT_EQ(counts.surface_reflected, 0U);
    EXPECT_EQ(counts.subsurface_reflected, 0U);
    const test::Estimate walked = test::share_of(counts.transmitted, counts.rays);
    EXPECT_LT(std::abs(fine - coarse), 0.2 * walked.standard_error) << "quadrature too coarse";
    const auto p_value = [&](double expected) {
        return test::two_sided_p_value((walked.value - expected) / walked.standard_error);
    };
    EXPECT_GT(p_value(fine), test::passing_p_value);
    EXPECT_LT(p_value(unreflected_transmittance(1.03 * depth[0], depth[1], 4)), test::passing_p_value)
        << "an optical depth 3 % too high passes";
}

}  // namespace
}  // namespace skinfit
