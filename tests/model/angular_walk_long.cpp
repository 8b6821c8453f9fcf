#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "model/angular_solver.hpp"
#include "model/random_walk.hpp"
#include "tests/model/angular_samples.hpp"
#include "tests/support/statistics.hpp"

/// The angular solver against 1e8 rays, whose standard error is about half of the solver's default accuracy.
namespace skinfit {
namespace {

constexpr std::uint64_t rays = 100'000'000;
constexpr double wavelength_nm = 560;
constexpr double accuracy = 2e-5;  // of the finest resolution; docs/model.md, "Angular solver"

/// How far the count lies from `share`, in standard errors, beyond what the solver's accuracy explains.
double z_of(std::uint64_t count, double share) {
    const test::Estimate walk = test::share_of(count, rays);
    return std::max(0.0, std::abs(walk.value - share) - accuracy) / walk.standard_error;
}

/// The p-value of the walk's counts, surface, subsurface and absorbed per layer, by the solver's shares.
double p_value(const WalkCounts& walk, const AngularResponse& response) {
    std::vector<double> z = {z_of(walk.surface_reflected, response.surface.share),
                             z_of(walk.subsurface_reflected, response.reflected.share)};
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        z.push_back(z_of(walk.absorbed[layer], response.absorbed[layer]));
    }
    return test::family_wise_p_value(z);
}

AngularResponse solved(const Sample& sample, double incidence_rad) {
    return AngularSolver(sample,
                         {.incidence_rad = incidence_rad, .resolution = AngularResolution::for_accuracy(accuracy)})
        .shares(wavelength_nm);
}

class HundredMillionRays : public testing::TestWithParam<Edition> {};

TEST_P(HundredMillionRays, HaveTheSolversShares) {
    constexpr double incidence_rad = 0.7;
    Sample sample;
    sample.edition = GetParam();
    const WalkCounts walk =
        random_walk(sample, {wavelength_nm}, {.incidence_rad = incidence_rad, .rays = rays, .seed = 23}).front();
    EXPECT_GT(p_value(walk, solved(sample, incidence_rad)), test::passing_p_value);
    sample.skin.fibril_radius_nm *= 1.01;
    EXPECT_LT(p_value(walk, solved(sample, incidence_rad)), test::passing_p_value) << "one per cent goes unnoticed";
}

INSTANTIATE_TEST_SUITE_P(Angular, HundredMillionRays, testing::Values(Edition::revised, Edition::printed),
                         [](const auto& edition) { return edition.param == Edition::revised ? "revised" : "printed"; });

}  // namespace
}  // namespace skinfit
