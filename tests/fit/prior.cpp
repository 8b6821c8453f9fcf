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

TEST(Prior, ResidualIsTheSignedRootOfTwiceTheFallOfTheLogDensity) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        for (const double x : c.points) {
            const double residual = prior_residual(c.prior, x).value;
            const double wanted = 2.0 * std::log(density(c.prior, mode(c.prior)) / density(c.prior, x));
            // Boost's densities are good to hundreds of roundings, a thousand for large exponents.
            EXPECT_NEAR(residual * residual, wanted, 4000 * epsilon * (1.0 + wanted)) << x;
            EXPECT_EQ(residual > 0.0, x > mode(c.prior)) << x;
        }
    }
}

TEST(Prior, SlopeIsTheDerivativeAtTheModeAndElsewhere) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        std::vector<double> points = c.points;
        points.push_back(mode(c.prior));
        for (const double x : points) {
            const auto central = [&](double h) {
                return (prior_residual(c.prior, x + h).value - prior_residual(c.prior, x - h).value) / (2.0 * h);
            };
            const double h = 1e-3 * std::min(x, std::abs(1.0 - x));
            const double once = (4.0 * central(h / 2) - central(h)) / 3.0;
            const double twice = (16.0 * (4.0 * central(h / 4) - central(h / 2)) / 3.0 - once) / 15.0;
            const double rounding = 8 * epsilon * (1.0 + std::abs(prior_residual(c.prior, x).value)) / (h / 4);
            EXPECT_NEAR(prior_residual(c.prior, x).slope, twice, std::abs(twice - once) + rounding) << x;
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

TEST(Prior, StandardDeviationIsThatOfTheDistribution) {
    constexpr double tolerance = 1e-5;  // of the integrals, relative: ten times what is asked of each
    EXPECT_NEAR(standard_deviation(NormalPrior{.mean = 1.0, .sigma = 0.01}, {-10.0, 20.0}), 0.01, 0.01 * tolerance);
    const double log_normal = 3.0 * std::exp(0.125) * std::sqrt(std::expm1(0.25));
    EXPECT_NEAR(standard_deviation(LogNormalPrior{.median = 3.0, .sigma_log = 0.5}, {0.0, 300.0}), log_normal,
                log_normal * tolerance);
    const double beta = std::sqrt(2.0 * 5.0 / (49.0 * 8.0));
    EXPECT_NEAR(standard_deviation(BetaPrior{.a = 2.0, .b = 5.0}, {0.0, 1.0}), beta, beta * tolerance);
    // So wide that the bounds decide: uniform; half of a normal one.
    EXPECT_NEAR(standard_deviation(NormalPrior{.mean = 0.5, .sigma = 1e4}, {0.0, 1.0}), 1.0 / std::sqrt(12.0), 1e-6);
    const double half = std::sqrt(1.0 - 2.0 / std::numbers::pi);
    EXPECT_NEAR(standard_deviation(NormalPrior{.mean = 0.0, .sigma = 1.0}, {0.0, 20.0}), half, half * tolerance);
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

TEST(Prior, SupportEndsAtAResidualOfEightWhereABoundHasNoDensity) {
    const Prior log_normal = LogNormalPrior{.median = 0.05, .sigma_log = 1.5};
    const Bounds positive = within_support(log_normal, {0.0, 3.0});
    EXPECT_NEAR(prior_residual(log_normal, positive.lower).value, -8.0, 1e-12);
    EXPECT_EQ(positive.upper, 3.0);
    const Prior beta = BetaPrior{.a = 2.0, .b = 5.0};
    const Bounds inner = within_support(beta, {0.0, 1.0});
    // 30 bits of the logarithm of the distance from the end.
    EXPECT_NEAR(prior_residual(beta, inner.lower).value, -8.0, 1e-6);
    EXPECT_NEAR(prior_residual(beta, inner.upper).value, 8.0, 1e-6);
    EXPECT_EQ(within_support(beta, {0.1, 0.9}).lower, 0.1);
    EXPECT_EQ(within_support(NormalPrior{.mean = 0.0, .sigma = 1e-3}, {0.0, 1.0}).upper, 1.0);
}

}  // namespace
}  // namespace skinfit::test
