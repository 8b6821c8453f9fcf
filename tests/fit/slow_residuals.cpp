#include "fit/slow_residuals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

Eigen::MatrixXd no_fit(Eigen::Index readings) {
    return {readings, 0};
}

TEST(SlowResiduals, OfFourReadingsAreTheirMeanAndTheirSlope) {
    Eigen::VectorXd residuals(4);
    residuals << 1.0, 2.0, -0.5, 0.7;
    // The two slowest cosines over four places; chi2 of two degrees of freedom has the tail exp(-x / 2).
    double mean = 0.0;
    double slope = 0.0;
    for (int i = 0; i < 4; ++i) {
        mean += residuals[i] / 2.0;
        slope += residuals[i] * std::cos(std::numbers::pi * (i + 0.5) / 4.0) / std::numbers::sqrt2;
    }
    EXPECT_NEAR(slow_residuals_p_value(residuals, no_fit(4)).value(), std::exp(-0.5 * (mean * mean + slope * slope)),
                1e-15);
}

TEST(SlowResiduals, WhatTheFitTakesDoesNotCount) {
    Eigen::VectorXd residuals(4);
    residuals << 1.0, 2.0, -0.5, 0.7;
    Eigen::MatrixXd mean_and_slope(4, 2);
    for (int i = 0; i < 4; ++i) {
        mean_and_slope(i, 0) = 0.5;
        mean_and_slope(i, 1) = std::cos(std::numbers::pi * (i + 0.5) / 4.0) / std::numbers::sqrt2;
    }
    EXPECT_FALSE(slow_residuals_p_value(residuals, mean_and_slope));
}

TEST(SlowResiduals, OfWhiteNoiseAreRarelyImprobable) {
    constexpr int draws = 4000;
    constexpr Eigen::Index readings = 61;
    constexpr double level = 0.01;
    const std::vector<double> normal = normal_numbers(11, draws * readings);
    int improbable = 0;
    for (int k = 0; k < draws; ++k) {
        const Eigen::Map<const Eigen::VectorXd> residuals(normal.data() + k * readings, readings);
        improbable += slow_residuals_p_value(residuals, no_fit(readings)).value() < level ? 1 : 0;
    }
    // Bonferroni: at most the level; five standard deviations of the count above it.
    EXPECT_LT(improbable, draws * level + 5.0 * std::sqrt(draws * level));
    EXPECT_GT(improbable, 0);
}

TEST(SlowResiduals, AWaveOfTheNoisesSizeIsSeenAndASawIsNot) {
    constexpr Eigen::Index readings = 61;
    Eigen::VectorXd wave(readings);
    Eigen::VectorXd saw(readings);
    for (Eigen::Index i = 0; i < readings; ++i) {
        wave[i] = std::numbers::sqrt2 * std::sin(0.3 * static_cast<double>(i));
        saw[i] = i % 2 == 0 ? 1.0 : -1.0;
    }
    EXPECT_LT(slow_residuals_p_value(wave, no_fit(readings)).value(), 1e-6);
    EXPECT_GT(slow_residuals_p_value(saw, no_fit(readings)).value(), 0.9);
    // Half as large they are less than the noise as stated lets them be: no reason to doubt it.
    EXPECT_GT(slow_residuals_p_value(0.3 * wave, no_fit(readings)).value(), 0.01);
}

}  // namespace
}  // namespace skinfit::test
