#include "fit/profile_curve.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fit/fit.hpp"
#include "fit/profile.hpp"
#include "fit/report.hpp"
#include "tests/fit/linear_misfit.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// An end is called reached when the root of the rise is this close to its threshold.
constexpr double root_at_end = 0.01;
constexpr double rise_at_end = 2.0 * normal_95 * root_at_end;

/// What holds of every profile, in positions or in values.
void expect_profile(const ProfileInterval& interval, const Bounds& bounds) {
    const ProfileCurve& curve = interval.curve;
    ASSERT_FALSE(curve.empty());
    EXPECT_TRUE(std::ranges::is_sorted(curve, std::ranges::less{}, &ProfilePoint::at));
    EXPECT_EQ(std::ranges::count(curve, 0.0, &ProfilePoint::cost_rise) > 0, true);
    for (const ProfilePoint& point : curve) {
        EXPECT_GE(point.cost_rise, 0.0);
        EXPECT_GE(point.at, bounds.lower);
        EXPECT_LE(point.at, bounds.upper);
    }
    for (const auto& [end, is_open] :
         {std::pair(interval.lower, interval.open_below), std::pair(interval.upper, interval.open_above)}) {
        const double beyond_threshold = cost_rise_at(curve, {}, end) - cost_rise_95_at(curve, {}, end);
        if (is_open) {
            EXPECT_LE(beyond_threshold, 0.0);
        } else {
            EXPECT_NEAR(beyond_threshold, 0.0, rise_at_end);
        }
    }
    if (interval.open_below) {
        EXPECT_EQ(curve.front().at, bounds.lower);
    }
    if (interval.open_above) {
        EXPECT_EQ(curve.back().at, bounds.upper);
    }
}

TEST(ProfileCurve, OfALinearModelIsTheParabolaOfItsCovariance) {
    const LinearExample example;
    const auto& [jacobian, centre, covariance, profile] = example;
    for (Eigen::Index i = 0; i < 2; ++i) {
        const ProfileInterval& found = profile.intervals[static_cast<std::size_t>(i)];
        expect_profile(found, {0.0, 1.0});
        const double variance = covariance(i, i);
        // To the ridge that keeps flat directions solvable, 1e-6 beside an information of at least 1e3.
        for (double share = 0.0; share <= 1.0; share += 0.05) {
            const double at = std::lerp(found.lower, found.upper, share);
            const double distance = at - centre[i];
            EXPECT_NEAR(cost_rise_at(found.curve, {}, at), distance * distance / variance, 1e-6);
        }
        for (const ProfilePoint& point : found.curve) {
            const double slope = 2.0 * (point.at - centre[i]) / variance;
            EXPECT_NEAR(point.cost_slope, slope, 1e-6 * (1.0 + std::abs(slope)));
            EXPECT_NEAR(point.cost_rise_95, normal_95 * normal_95, rounding);
        }
        EXPECT_NEAR(cost_rise_at(found.curve, {}, found.upper), normal_95 * normal_95, 1e-6);
    }
}

TEST(ProfileCurve, OfABentModelPassesThroughItsCost) {
    const auto residual = [](double x) { return (x * x * x - 0.125) / 0.02; };
    const auto slope = [](double x) { return 3.0 * x * x / 0.02; };
    const BoxMisfit misfit = [&](const VectorXd& position) {
        return Misfit{.residual = VectorXd::Constant(1, residual(position[0])),
                      .jacobian = MatrixXd::Constant(1, 1, slope(position[0]))};
    };
    const ProfileInterval found = profile_intervals(misfit, VectorXd::Constant(1, 0.5)).intervals.front();
    expect_profile(found, {0.0, 1.0});
    ASSERT_GE(found.curve.size(), 3U);
    double farthest_from_parabola = 0.0;
    const double sigma = 1.0 / slope(0.5);
    for (const ProfilePoint& point : found.curve) {
        const double cost = residual(point.at) * residual(point.at);
        EXPECT_NEAR(point.cost_rise, cost, rounding);
        EXPECT_NEAR(point.cost_slope, 2.0 * residual(point.at) * slope(point.at), 1e-6);
        farthest_from_parabola =
            std::max(farthest_from_parabola, std::abs(cost - std::pow((point.at - 0.5) / sigma, 2)));
    }
    EXPECT_GT(farthest_from_parabola, 0.1);
}

TEST(ProfileCurve, ReachesTheBoundWhereTheIntervalDoes) {
    MatrixXd jacobian(1, 2);
    jacobian << 100, 100;
    VectorXd centre(2);
    centre << 0.2, 0.1;
    for (const ProfileInterval& found : profile_intervals(linear(jacobian, centre), centre).intervals) {
        EXPECT_TRUE(found.open_below);
        expect_profile(found, {0.0, 1.0});
        EXPECT_NEAR(found.curve.front().cost_rise_95, one_sided_95 * one_sided_95, rounding);
    }
}

TEST(ProfileCurve, StaysAtZeroWhereNothingHasAnEffect) {
    MatrixXd jacobian(3, 2);
    jacobian << 100, 0, 50, 0, 20, 0;
    VectorXd centre(2);
    centre << 0.5, 0.3;
    const ProfileInterval found = profile_intervals(linear(jacobian, centre), centre).intervals[1];
    expect_profile(found, {0.0, 1.0});
    for (const ProfilePoint& point : found.curve) EXPECT_NEAR(point.cost_rise, 0.0, rounding);
}

TEST(ProfileCurve, IsExactForCubicsAndEndsAtItsEnds) {
    const auto cubic = [](double x) { return 3.0 + x * (2.0 + x * (-1.0 + x)); };
    const auto slope = [](double x) { return 2.0 + x * (-2.0 + 3.0 * x); };
    ProfileCurve curve;
    for (const double at : {-0.5, 0.2, 1.0}) {
        curve.push_back({.at = at, .cost_rise = cubic(at), .cost_slope = slope(at), .cost_rise_95 = 3.0 + at});
    }
    for (double at = -0.5; at <= 1.0; at += 0.01) EXPECT_NEAR(cost_rise_at(curve, {}, at), cubic(at), 1e-12);
    EXPECT_EQ(cost_rise_at(curve, {}, -2.0), cubic(-0.5));
    EXPECT_EQ(cost_rise_at(curve, {}, 2.0), cubic(1.0));
    EXPECT_EQ(cost_rise_at({curve[1]}, {}, 0.9), cubic(0.2));
    EXPECT_NEAR(cost_rise_95_at(curve, {}, 0.7), 3.7, 1e-12);
    EXPECT_EQ(cost_rise_95_at(curve, {}, 2.0), 4.0);
}

/// A parabola of the logarithm, known at three points that lie decades apart.
TEST(ProfileCurve, IsCubicInTheNaturalCoordinate) {
    const Prior prior = LogNormalPrior{.median = 0.05, .sigma_log = 1.5};
    const auto score = [](double x) { return std::log(x / 0.05) / 1.5; };
    ProfileCurve curve;
    for (const double at : {0.002, 0.05, 1.0}) {
        const double slope = 2.0 * score(at) / (1.5 * at);
        curve.push_back({.at = at, .cost_rise = std::pow(score(at), 2), .cost_slope = slope, .cost_rise_95 = 3.84});
    }
    for (const double at : {0.003, 0.01, 0.2, 0.9}) {
        EXPECT_NEAR(cost_rise_at(curve, prior, at), std::pow(score(at), 2), 1e-12) << at;
        EXPECT_GT(std::abs(cost_rise_at(curve, {}, at) - std::pow(score(at), 2)), 0.01) << at;
    }
}

/// A specimen whose parameters all lie many sigmas from their bounds, so that the model is nearly linear within reach.
FitResult fitted(UncertaintyMethod uncertainty) {
    Configuration truth = quick_configuration();
    truth.values.skin.bilirubin_g_per_l = 1.0;
    truth.values.skin.papillary_blood_fraction = 0.03;
    truth.values.skin.oxygen_saturation = 0.6;
    truth.noise = 1e-4;
    truth.uncertainty = uncertainty;
    return fit_spectrum(truth, modelled_spectrum(truth, grid_nm(400, 700, 10)), {.cache = no_cache()});
}

TEST(ProfileCurve, OfAFitIsInItsValuesAndNearlyThatOfTheCovariance) {
    const FitResult result = fitted(UncertaintyMethod::profile);
    ASSERT_TRUE(result.profile);
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const FittedParameter& free = result.free[i];
        const ProfileInterval& found = result.profile->intervals[i];
        EXPECT_EQ(found.lower, free.uncertainty.interval_95.lower);
        EXPECT_EQ(found.upper, free.uncertainty.interval_95.upper);
        expect_profile(found, free.bounds);
        ASSERT_TRUE(free.uncertainty.sigma) << free.name;
        const auto lowest = std::ranges::min_element(found.curve, {}, &ProfilePoint::cost_rise);
        // The solver and the profile's own descent end within a part in a hundred of a sigma.
        EXPECT_NEAR((lowest->at - free.value) / *free.uncertainty.sigma, 0.0, 0.01) << free.name;
        for (const ProfilePoint& point : found.curve) {
            const double distance = (point.at - free.value) / *free.uncertainty.sigma;
            EXPECT_NEAR(std::sqrt(point.cost_rise), std::abs(distance), 0.05 * (1.0 + std::abs(distance))) << free.name;
        }
    }
}

TEST(ProfileCurve, OfWhatTheReadingIsLinearInHasTheSlopesOfItsParabola) {
    // A fit adjusts something of the skin too: this one so little that the reading is linear in it.
    Configuration truth =
        with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::scale, Parameter::offset});
    truth.priors[static_cast<std::size_t>(Parameter::melanosome_fraction)] =
        NormalPrior{.mean = truth.values.skin.melanosome_fraction, .sigma = 1e-6};
    truth.uncertainty = UncertaintyMethod::profile;
    const FitResult result =
        fit_spectrum(truth, modelled_spectrum(truth, grid_nm(400, 700, 10)), {.cache = no_cache()});
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const double sigma = *result.free[i].uncertainty.sigma;
        const ProfileCurve& curve = result.profile->intervals[i].curve;
        ASSERT_GE(curve.size(), 3U);
        for (const ProfilePoint& point : curve) {
            // In sigmas; to the ridge of 1e-6 beside the information and to what the descents leave.
            const double distance = (point.at - result.free[i].value) / sigma;
            EXPECT_NEAR(point.cost_slope * sigma, 2.0 * distance, 1e-3) << result.free[i].name;
        }
    }
}

TEST(ProfileCurve, IsInTheReportForPrograms) {
    const FitResult result = fitted(UncertaintyMethod::profile);
    const Json report = json_report(result);
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const FittedParameter& free = result.free[i];
        const ProfileCurve& curve = result.profile->intervals[i].curve;
        const Json& json = report["uncertainty"]["profile"]["curves"][free.name];
        for (const char* key : {"value", "cost_rise", "cost_slope", "cost_rise_95"}) {
            ASSERT_EQ(json[key].size(), curve.size()) << key;
        }
        for (std::size_t k = 0; k < curve.size(); ++k) {
            EXPECT_EQ(json["value"][k], curve[k].at);
            EXPECT_EQ(json["cost_rise"][k], curve[k].cost_rise);
            EXPECT_EQ(json["cost_slope"][k], curve[k].cost_slope);
            EXPECT_EQ(json["cost_rise_95"][k], curve[k].cost_rise_95);
        }
    }
}

TEST(ProfileCurve, IsNotMadeUnlessAskedFor) {
    const FitResult result = fitted(UncertaintyMethod::covariance);
    EXPECT_FALSE(result.profile);
    EXPECT_FALSE(json_report(result)["uncertainty"].contains("profile"));
}

}  // namespace
}  // namespace skinfit::test
