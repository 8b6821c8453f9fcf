#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/angular_solver.hpp"
#include "tests/model/angular_samples.hpp"

/// How fast the angular solver converges, measured against a resolution finer than any it offers.
namespace skinfit {
namespace {

constexpr AngularResolution beyond_all = {
    .panels = 24, .rayleigh_terms = 32, .points = 10, .crowded_points = 40, .entry_panels = 96};

/// The largest error of the shares that escape, 400 to 700 nm.
double largest_error(const AngularCase& angular, const AngularResolution& resolution, double step_nm) {
    const AngularSolver coarse(angular.sample, {.incidence_rad = angular.incidence_rad, .resolution = resolution});
    const AngularSolver fine(angular.sample, {.incidence_rad = angular.incidence_rad, .resolution = beyond_all});
    double largest = 0.0;
    for (double wavelength_nm = 400; wavelength_nm <= 700; wavelength_nm += step_nm) {
        const AngularResponse a = coarse.shares(wavelength_nm);
        const AngularResponse b = fine.shares(wavelength_nm);
        largest = std::max({largest, std::abs(a.reflected.share - b.reflected.share),
                            std::abs(a.transmitted.share - b.transmitted.share)});
    }
    return largest;
}

class Accuracy : public testing::TestWithParam<AngularCase> {};

TEST_P(Accuracy, EachResolutionIsAsAccurateAsItSays) {
    for (const double accuracy : {1e-3, 1e-4, 2e-5}) {
        EXPECT_LE(largest_error(GetParam(), AngularResolution::for_accuracy(accuracy), 20), accuracy);
    }
}

INSTANTIATE_TEST_SUITE_P(Angular, Accuracy, testing::ValuesIn(all_angular_cases()), case_name);

// The factor of a cone is the light of single directions and has no more than half the accuracy of the shares, as
// docs/model.md says.
TEST(ConeAccuracy, At45DegreesTheFactorIsWithinTwiceTheAccuracyOfShares) {
    for (const AngularCase& angular : all_angular_cases()) {
        if (angular.incidence_rad != 45 * rad_per_deg) continue;
        const auto solver = [&](const AngularResolution& resolution) {
            return AngularSolver(angular.sample, {.incidence_rad = angular.incidence_rad,
                                                  .viewing_cone_rad = 5 * rad_per_deg,
                                                  .resolution = resolution});
        };
        const AngularSolver fine = solver(beyond_all);
        for (const double accuracy : {1e-3, 1e-4, 2e-5}) {
            const AngularSolver coarse = solver(AngularResolution::for_accuracy(accuracy));
            for (double wavelength_nm = 400; wavelength_nm <= 700; wavelength_nm += 50) {
                EXPECT_NEAR(coarse.shares(wavelength_nm).viewed.share, fine.shares(wavelength_nm).viewed.share,
                            2.0 * accuracy)
                    << angular.name << ", " << wavelength_nm << " nm";
            }
        }
    }
}

/// The root mean square over the cases of an edition: single cases are irregular, since panels move past the critical
/// angles and errors change sign.
double typical_error(Edition edition, const AngularResolution& resolution) {
    double squares = 0.0;
    int count = 0;
    for (const AngularCase& angular : all_angular_cases()) {
        if (angular.sample.edition != edition) continue;
        squares += std::pow(largest_error(angular, resolution, 100), 2);
        ++count;
    }
    return std::sqrt(squares / count);
}

double observed_order(double coarse_error, double fine_error, double refinement) {
    return std::log(coarse_error / fine_error) / std::log(refinement);
}

TEST(ConvergenceOrder, OfPanelsIsTwoAtLeast) {
    const auto panels = [](int count) {
        return AngularResolution{
            .panels = count, .rayleigh_terms = 32, .points = 10, .crowded_points = 40, .entry_panels = 96};
    };
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        const double order = observed_order(typical_error(edition, panels(2)), typical_error(edition, panels(16)), 8.0);
        RecordProperty(edition == Edition::printed ? "printed" : "revised", std::to_string(order));
        EXPECT_GE(order, 2.0);
    }
}

TEST(ConvergenceOrder, OfRayleighTermsIsTwoAtLeast) {
    const auto terms = [](int count) {
        return AngularResolution{
            .panels = 24, .rayleigh_terms = count, .points = 10, .crowded_points = 40, .entry_panels = 96};
    };
    const double order =
        observed_order(typical_error(Edition::printed, terms(2)), typical_error(Edition::printed, terms(16)), 8.0);
    RecordProperty("order", std::to_string(order));
    EXPECT_GE(order, 2.0);
}

}  // namespace
}  // namespace skinfit
