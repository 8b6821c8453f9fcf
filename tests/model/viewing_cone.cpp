#include "model/viewing_cone.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "model/angular_solver.hpp"
#include "model/scattering.hpp"
#include "model/spectrophotometer.hpp"
#include "tests/model/angular_samples.hpp"

namespace skinfit {
namespace {

constexpr double right_angle = 0.5 * pi;
// Of the angular solver's elimination: see tests/model/angular_solver.cpp.
constexpr double rounding = 1e-12;

class SeenByCone : public testing::TestWithParam<AngularCase> {
protected:
    [[nodiscard]] static AngularSolver solver(std::optional<double> cone_rad) {
        return {GetParam().sample, {.incidence_rad = GetParam().incidence_rad, .viewing_cone_rad = cone_rad}};
    }
};

TEST_P(SeenByCone, TheWholeHemisphereIsTheReflectedShare) {
    const AngularResponse response = solver(right_angle).respond(560);
    EXPECT_DOUBLE_EQ(response.viewed.share, response.reflected.share);
    EXPECT_NEAR(response.viewed.share, solver(std::nullopt).shares(560).reflected.share, rounding);
    for (std::size_t p = 0; p < parameter_count; ++p) {
        const double by = response.reflected.by_parameter[p];
        EXPECT_NEAR(response.viewed.by_parameter[p], by, rounding * (1.0 + std::abs(by)));
    }
}

TEST_P(SeenByCone, WithoutAConeAllReflectedLightIsSeen) {
    const AngularResponse response = solver(std::nullopt).respond(560);
    EXPECT_EQ(response.viewed.share, response.reflected.share);
    EXPECT_EQ(response.viewed.by_parameter, response.reflected.by_parameter);
    EXPECT_EQ(response.viewed.by_optical_depth, response.reflected.by_optical_depth);
}

TEST_P(SeenByCone, TheFactorIsTheExitShareOverThatOfAWhiteDiffuser) {
    // `exit_shares` integrates the same light apart. Its integrand is analytic down to a cosine of 0, at least 20 half
    // widths of the cone's cosines away: what its rule of 12 points leaves out is of the order of 40^-24.
    for (const double cone_rad : {0.02, 0.1, 0.3}) {
        const AngularSolver angular = solver(cone_rad);
        const std::vector<double> share = angular.exit_shares(620, Side::top, std::vector{std::cos(cone_rad), 1.0});
        EXPECT_NEAR(angular.shares(620).viewed.share, share[0] / white_share(cone_rad),
                    rounding / white_share(cone_rad));
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, SeenByCone, testing::ValuesIn(all_angular_cases()), case_name);

TEST(WhiteDiffuser, SendsIntoAConeWhatTheCosineLawDoes) {
    // Two roundings of numbers up to 1.
    constexpr double few_roundings = 4e-16;
    for (const double cone_rad : {0.02, 0.1, 0.3, 1.0, 1.5, right_angle}) {
        const double diffused = 1.0 - DiffuseScattering::share_below(std::cos(cone_rad));
        EXPECT_NEAR(white_share(cone_rad), diffused, few_roundings);
    }
    EXPECT_EQ(white_share(std::nullopt), 1.0);
}

TEST(ViewedWalk, FollowsTheRaysOfTheRandomWalk) {
    const WalkOptions options{.incidence_rad = 0.7, .rays = 20'000, .seed = 3};
    const std::vector<double> wavelengths_nm = {450, 650};
    const auto plain = random_walk(Sample{}, wavelengths_nm, options);
    const auto viewed = viewed_walk(Sample{}, wavelengths_nm, options, 0.3);
    const auto whole = viewed_walk(Sample{}, wavelengths_nm, options, right_angle);
    const auto without = viewed_walk(Sample{}, wavelengths_nm, options, std::nullopt);
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        EXPECT_EQ(viewed[i].totals, plain[i]);
        EXPECT_GT(viewed[i].viewed, 0U);
        EXPECT_LT(viewed[i].viewed, plain[i].subsurface_reflected);
        EXPECT_EQ(whole[i].viewed, plain[i].subsurface_reflected);
        EXPECT_EQ(without[i].viewed, plain[i].subsurface_reflected);
    }
}

TEST(ViewedWalk, DoesNotDependOnTheThreads) {
    const WalkOptions options{.incidence_rad = 0.7, .rays = 20'000, .seed = 3};
    const auto many = viewed_walk(Sample{}, {600}, options, 0.3);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const auto one = viewed_walk(Sample{}, {600}, options, 0.3);
    EXPECT_EQ(many[0].totals, one[0].totals);
    EXPECT_EQ(many[0].viewed, one[0].viewed);
}

TEST(ConeReading, IsScaledAndHasNoSurfaceReflection) {
    Experiment experiment;
    experiment.incidence_rad = 0.8;
    experiment.specular = Specular::excluded;
    experiment.viewing_cone_rad = 0.2;
    experiment.values.instrument = {.scale = 1.1, .offset = 0.01};
    const double factor = angular_solver(experiment).shares(600).viewed.share;
    EXPECT_DOUBLE_EQ(read_by_solver(experiment, {600})[0].reflectance, 1.1 * factor + 0.01);
}

TEST(ConeReading, ByWalkHasTheErrorItStates) {
    Experiment experiment;
    experiment.incidence_rad = 0.8;
    experiment.specular = Specular::excluded;
    experiment.viewing_cone_rad = 0.2;
    const Reading walked = read_by_walk(experiment, {640}, 200'000, 5)[0];
    const Reading solved = read_by_solver(experiment, {640})[0];
    // Rays in the cone are counted: binomial.
    const double seen = white_share(experiment.viewing_cone_rad);
    const double share = walked.reflectance * seen;
    EXPECT_NEAR(walked.reflectance_se, std::sqrt(share * (1.0 - share) / 199'999.0) / seen, rounding);
    // Beyond 4.9 standard errors lies a millionth of the normal law.
    EXPECT_NEAR(walked.reflectance, solved.reflectance, 4.9 * walked.reflectance_se);
}

}  // namespace
}  // namespace skinfit
