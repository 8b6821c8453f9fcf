#include "fit/profile.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/fit/linear_misfit.hpp"

namespace skinfit::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One position measured with `sigma` to lie at `centre`.
BoxMisfit measured_once(double centre, double sigma) {
    return linear(MatrixXd::Constant(1, 1, 1.0 / sigma), VectorXd::Constant(1, centre));
}

ProfileInterval profile_of_one(const BoxMisfit& misfit, double minimum) {
    return profile_intervals(misfit, VectorXd::Constant(1, minimum)).intervals.front();
}

double normal_share_below(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

TEST(CriticalRoot, IsOneSidedAtTheBoundAndTwoSidedFarFromIt) {
    EXPECT_NEAR(critical_root(0.0), one_sided_95, rounding);
    EXPECT_NEAR(critical_root(1.96), normal_95, rounding);
    EXPECT_EQ(critical_root(1e9), critical_root(2.0));
}

TEST(CriticalRoot, LeavesFivePercentOfMeasurementsOutside) {
    // Of measurements x of a mean d above the bound: (x - d)^2 less the square of x where x is below the bound.
    for (const double d : {0.1, 0.5, 1.0, 1.5, 1.9}) {
        const double squared = critical_root(d) * critical_root(d);
        const auto inside = [&](double x) {
            return (x - d) * (x - d) - std::min(x, 0.0) * std::min(x, 0.0) <= squared;
        };
        const double step = 1e-4;
        double share = 0.0;
        for (double x = d - 12.0; x < d + 8.0; x += step) {
            if (inside(x + 0.5 * step)) share += normal_share_below(x + step - d) - normal_share_below(x - d);
        }
        EXPECT_NEAR(share, 0.95, step);  // of the grid, at most one cell of density below 0.4 at either end
    }
}

TEST(Profile, OfALinearModelIs196SigmaFarFromBounds) {
    const LinearExample example;
    const auto& [jacobian, centre, covariance, profile] = example;
    for (Eigen::Index i = 0; i < 2; ++i) {
        const ProfileInterval& found = profile.intervals[static_cast<std::size_t>(i)];
        const double reach = normal_95 * std::sqrt(covariance(i, i));
        // The ridge that keeps flat directions solvable is 1e-6 beside an information of at least 1e3.
        EXPECT_NEAR(found.lower, centre[i] - reach, 1e-8);
        EXPECT_NEAR(found.upper, centre[i] + reach, 1e-8);
        EXPECT_FALSE(found.open_below || found.open_above);
    }
    EXPECT_FALSE(profile.better_minimum);
    // Where the model is linear each end takes one evaluation; the minimum takes two.
    EXPECT_LE(profile.evaluations, 6);
}

TEST(Profile, AtABoundHasTheLimitOfAMeasurementAtIt) {
    const ProfileInterval found = profile_of_one(measured_once(0.0, 0.01), 0.0);
    EXPECT_EQ(found.lower, 0.0);
    EXPECT_TRUE(found.open_below);
    EXPECT_NEAR(found.upper, normal_95 * 0.01, 1e-6);
    EXPECT_FALSE(found.open_above);
}

TEST(Profile, OfAMeasurementBeyondTheBoundSolvesTheLikelihoodRatio) {
    constexpr double sigma = 0.02;
    for (const double beyond : {0.5, 1.0, 2.0}) {
        for (const bool above : {false, true}) {
            const double centre = above ? 1.0 + beyond * sigma : -beyond * sigma;
            const ProfileInterval found = profile_of_one(measured_once(centre, sigma), above ? 1.0 : 0.0);
            const double distance = (above ? 1.0 - found.lower : found.upper) / sigma;
            // (distance + beyond)^2 - beyond^2 has reached the threshold that belongs to this distance, to what the
            // search calls close enough.
            EXPECT_NEAR(std::sqrt(distance * (distance + 2.0 * beyond)), critical_root(distance), 0.01);
            EXPECT_EQ(above ? found.upper : found.lower, above ? 1.0 : 0.0);
        }
    }
}

TEST(Profile, ReachesTheBoundWithinOneSidedSigmasOfIt) {
    constexpr double sigma = 0.01;
    EXPECT_TRUE(profile_of_one(measured_once(1.64 * sigma, sigma), 1.64 * sigma).open_below);
    EXPECT_FALSE(profile_of_one(measured_once(1.65 * sigma, sigma), 1.65 * sigma).open_below);
}

TEST(Profile, IsTheSameOnAnyScaleOfTheParameter) {
    // Measured on a bent scale g: the interval is that of the straight scale, mapped back.
    const auto bent = [](double x) { return x * x * x; };
    const BoxMisfit misfit = [&](const VectorXd& position) {
        const double x = position[0];
        return Misfit{.residual = VectorXd::Constant(1, (bent(x) - 0.125) / 0.02),
                      .jacobian = MatrixXd::Constant(1, 1, 3.0 * x * x / 0.02)};
    };
    const ProfileInterval found = profile_of_one(misfit, 0.5);
    EXPECT_NEAR(bent(found.lower), 0.125 - normal_95 * 0.02, 1e-5);
    EXPECT_NEAR(bent(found.upper), 0.125 + normal_95 * 0.02, 1e-5);
}

TEST(Profile, OfWhatHasNoEffectIsEverything) {
    MatrixXd jacobian(3, 2);
    jacobian << 100, 0, 50, 0, 20, 0;
    VectorXd centre(2);
    centre << 0.5, 0.0;
    for (const double flat : {0.0, 0.3, 1.0}) {
        VectorXd minimum = centre;
        minimum[1] = flat;
        const Profile profile = profile_intervals(linear(jacobian, centre), minimum);
        EXPECT_TRUE(profile.intervals[1].is_everything());
        EXPECT_EQ(profile.intervals[1].lower, 0.0);
        EXPECT_EQ(profile.intervals[1].upper, 1.0);
        EXPECT_FALSE(profile.intervals[0].open_below || profile.intervals[0].open_above);
    }
}

TEST(Profile, OfTwinsEndsWhereTheOtherMeetsItsBound) {
    // Only the sum is known, to be 0.3 +/- 0.01: each may be 0 to a little more than 0.3.
    MatrixXd jacobian(1, 2);
    jacobian << 100, 100;
    VectorXd centre(2);
    centre << 0.2, 0.1;
    const Profile profile = profile_intervals(linear(jacobian, centre), centre);
    for (const ProfileInterval& found : profile.intervals) {
        EXPECT_TRUE(found.open_below);
        // With the other at zero it is measured by itself.
        EXPECT_NEAR(found.upper, 0.3 + normal_95 * 0.01, 1e-4);
    }
}

TEST(Profile, FlatAtItsBoundStillExcludesWhatIsFarAway) {
    // The measured effect of x levels off: the spectrum says nothing near 1 and much near 0.
    const BoxMisfit misfit = [](const VectorXd& position) {
        const double rest = 1.0 - position[0];
        return Misfit{.residual = VectorXd::Constant(1, 50.0 * std::pow(rest, 4) + 0.1),
                      .jacobian = MatrixXd::Constant(1, 1, -200.0 * std::pow(rest, 3))};
    };
    const ProfileInterval found = profile_of_one(misfit, 1.0);
    EXPECT_TRUE(found.open_above);
    EXPECT_FALSE(found.open_below);
    const double rest = 1.0 - found.lower;
    const double root = std::sqrt(std::pow(50.0 * std::pow(rest, 4) + 0.1, 2) - 0.01);
    EXPECT_GT(root, one_sided_95 - 1e-3);
    EXPECT_LT(root, normal_95 + 1e-3);
}

TEST(Profile, MeetsABetterMinimumAndStartsAgainThere) {
    // Two valleys, near 0.3 and near 0.7, the second the deeper one.
    const BoxMisfit misfit = [](const VectorXd& position) {
        const double x = position[0];
        const double product = (x - 0.3) * (x - 0.7) / 0.02;
        Misfit result{.residual = VectorXd(2), .jacobian = MatrixXd(2, 1)};
        result.residual << product, 4.0 * (1.0 - x);
        result.jacobian << (2.0 * x - 1.0) / 0.02, -4.0;
        return result;
    };
    const Profile profile = profile_intervals(misfit, VectorXd::Constant(1, 0.3));
    EXPECT_TRUE(profile.better_minimum);
    EXPECT_NEAR(profile.minimum[0], 0.7, 0.02);
    EXPECT_GT(profile.intervals.front().upper, 0.7);
}

}  // namespace
}  // namespace skinfit::test
