#include "fit/prior.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace skinfit::test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Case {
    const char* name;
    Prior prior;
    std::vector<double> points;
};

const std::vector<Case> cases = {
    {"normal", NormalPrior{.mean = 150.0, .sigma = 10.0}, {100.0, 149.0, 150.0, 151.0, 190.0}},
    {"log-normal", LogNormalPrior{.median = 0.05, .sigma_log = 1.5}, {1e-4, 0.005, 0.0053, 0.05, 2.0}},
    {"beta", BetaPrior{.a = 2.0, .b = 5.0}, {1e-4, 0.19, 0.2, 0.21, 0.999}},
    {"narrow beta", BetaPrior{.a = 300.0, .b = 700.0}, {0.2, 0.298, 0.299, 0.35}},
};

/// Densities as Boost computes them.
double density(const Prior& prior, double x) {
    if (const auto* normal = std::get_if<NormalPrior>(&prior)) {
        return boost::math::pdf(boost::math::normal_distribution<double>(normal->mean, normal->sigma), x);
    }
    if (const auto* log_normal = std::get_if<LogNormalPrior>(&prior)) {
        return boost::math::pdf(
            boost::math::lognormal_distribution<double>(std::log(log_normal->median), log_normal->sigma_log), x);
    }
    const auto& beta = std::get<BetaPrior>(prior);
    return boost::math::pdf(boost::math::beta_distribution<double>(beta.a, beta.b), x);
}

double share_below(const Prior& prior, double x) {
    return mass_within(prior, {.lower = -1e9, .upper = x});
}

TEST(Prior, ResidualIsTheNormalScore) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        for (const double x : c.points) {
            const double score = prior_residual(c.prior, x).value;
            const double normal_share = 0.5 * std::erfc(-score / std::numbers::sqrt2);
            EXPECT_NEAR(normal_share, share_below(c.prior, x), 1e-13) << x;
            EXPECT_NEAR(value_at_coordinate(c.prior, score), x, 1e-12 * (1.0 + std::abs(x))) << x;
        }
    }
}

TEST(Prior, ResidualIsZeroAtTheMedianWhateverTheScale) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const double median = prior_median(c.prior);
        EXPECT_NEAR(prior_residual(c.prior, median).value, 0.0, 1e-9);
        EXPECT_NEAR(share_below(c.prior, median), 0.5, 1e-12);
    }
    EXPECT_DOUBLE_EQ(prior_median(LogNormalPrior{.median = 0.05, .sigma_log = 1.5}), 0.05);
}

/// In both tails, where one of the two shares is rounded away.
TEST(Prior, ScoresOfTheTailsOfABetaAreExact) {
    const Prior beta = BetaPrior{.a = 2.0, .b = 5.0};
    for (const double score : {-7.5, -3.0, 3.0, 6.0}) {
        EXPECT_NEAR(prior_residual(beta, value_at_coordinate(beta, score)).value, score, 1e-9) << score;
    }
}

TEST(Prior, LogDensityIsThatOfBoost) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        for (const double x : c.points) {
            const double constant = log_density(c.prior, c.points[1]).value - std::log(density(c.prior, c.points[1]));
            const double wanted = std::log(density(c.prior, x)) + constant;
            // Boost's densities are good to hundreds of roundings, a thousand for large exponents.
            EXPECT_NEAR(log_density(c.prior, x).value, wanted, 4000 * epsilon * (1.0 + std::abs(wanted))) << x;
            EXPECT_LE(log_density(c.prior, x).value, 0.0) << x;
            const double score = prior_residual(c.prior, x).value;
            const double slope = log_score_slope(c.prior, x).value - log_score_slope(c.prior, c.points[1]).value;
            const double ratio = prior_residual(c.prior, x).slope / prior_residual(c.prior, c.points[1]).slope;
            EXPECT_NEAR(slope, std::log(ratio), 1e-8 * (1.0 + score * score)) << x;
        }
    }
}

TEST(Prior, SlopesAreTheDerivatives) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        for (const auto& function : {&prior_residual, &log_density, &log_score_slope}) {
            for (const double x : c.points) {
                const auto central = [&](double h) {
                    return (function(c.prior, x + h).value - function(c.prior, x - h).value) / (2.0 * h);
                };
                const double h = 1e-3 * std::min(x, std::abs(1.0 - x));
                const double once = (4.0 * central(h / 2) - central(h)) / 3.0;
                const double twice = (16.0 * (4.0 * central(h / 4) - central(h / 2)) / 3.0 - once) / 15.0;
                const double score = prior_residual(c.prior, x).value;
                // Scores of a beta are good to hundreds of roundings.
                const double rounding = 400 * epsilon * (1.0 + score * score) / (h / 4);
                EXPECT_NEAR(function(c.prior, x).slope, twice, std::abs(twice - once) + rounding) << x;
            }
        }
    }
}

TEST(Prior, ResidualIsInfiniteWhereThereIsNoDensity) {
    EXPECT_EQ(prior_residual(LogNormalPrior{.median = 1.0, .sigma_log = 1.0}, 0.0).value, -INFINITY);
    EXPECT_EQ(prior_residual(BetaPrior{.a = 2.0, .b = 2.0}, 0.0).value, -INFINITY);
    EXPECT_EQ(prior_residual(BetaPrior{.a = 2.0, .b = 2.0}, 1.0).value, INFINITY);
}

TEST(Prior, MassOfItsOwnQuantileRangeIsThatRange) {
    EXPECT_NEAR(mass_within(NormalPrior{.mean = 1.0, .sigma = 2.0}, {-1.0, 3.0}), std::erf(std::sqrt(0.5)),
                4 * epsilon);
    EXPECT_NEAR(mass_within(LogNormalPrior{.median = 3.0, .sigma_log = 0.5}, {0.0, 3.0}), 0.5, 4 * epsilon);
    EXPECT_NEAR(mass_within(BetaPrior{.a = 2.0, .b = 2.0}, {0.0, 0.5}), 0.5, 4 * epsilon);
}

TEST(Prior, QuantileWithinBoundsHasTheShareBelow) {
    for (const Prior& prior : {Prior(NormalPrior{.mean = 0.1, .sigma = 0.2}),
                               Prior(LogNormalPrior{.median = 0.05, .sigma_log = 1.5}), Prior(BetaPrior{2.0, 5.0})}) {
        const Bounds bounds{.lower = 0.02, .upper = 0.7};
        for (const double share : {0.0, 1e-3, 0.3, 0.5, 0.9, 1.0}) {
            const double value = quantile_within(prior, bounds, share);
            EXPECT_NEAR(mass_within(prior, {bounds.lower, value}) / mass_within(prior, bounds), share, 1e-12);
        }
    }
}

TEST(Prior, SupportEndsAtAScoreOfEightWhereABoundHasNoDensity) {
    const Prior log_normal = LogNormalPrior{.median = 0.05, .sigma_log = 1.5};
    const Bounds positive = within_support(log_normal, {0.0, 3.0});
    EXPECT_NEAR(prior_residual(log_normal, positive.lower).value, -8.0, 1e-12);
    EXPECT_EQ(positive.upper, 3.0);
    const Prior beta = BetaPrior{.a = 2.0, .b = 5.0};
    const Bounds inner = within_support(beta, {0.0, 1.0});
    EXPECT_NEAR(prior_residual(beta, inner.lower).value, -8.0, 1e-6);
    EXPECT_NEAR(prior_residual(beta, inner.upper).value, 8.0, 1e-6);
    // So steep that no number below 1 has a score of 8.
    const Prior steep = BetaPrior{.a = 5.0, .b = 1.001};
    EXPECT_LT(within_support(steep, {0.0, 1.0}).upper, 1.0);
    EXPECT_TRUE(std::isfinite(prior_residual(steep, within_support(steep, {0.0, 1.0}).upper).value));
    EXPECT_EQ(within_support(beta, {0.1, 0.9}).lower, 0.1);
    EXPECT_EQ(within_support(NormalPrior{.mean = 0.0, .sigma = 1e-3}, {0.0, 1.0}).upper, 1.0);
}

}  // namespace
}  // namespace skinfit::test
