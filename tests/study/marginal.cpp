#include "study/marginal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/study/example_rows.hpp"

namespace skinfit {
namespace {

using test::example_estimate;

constexpr double slice = 1.0 / 200.0;  // of probability, between neighbouring quantiles

double normal_cdf(double z) {
    return std::erfc(-z / std::sqrt(2.0)) / 2.0;
}

/// Any distribution and the one linear between its quantiles agree where those are; between, by a slice at the most.
TEST(MarginalDistribution, OfASymmetricEstimateIsNormal) {
    const MarginalDistribution marginal = marginal_of(example_estimate("oxygen_saturation", 0.5, 0.05)).value();
    for (double x = 0.3; x < 0.7; x += 0.0037) {
        EXPECT_NEAR(marginal.probability_above(x), 1.0 - normal_cdf((x - 0.5) / 0.05), slice) << x;
    }
    EXPECT_NEAR(marginal.probability_above(0.5), 0.5, 1e-9);                               // a quantile
    EXPECT_NEAR(marginal.probability_above(0.5 + 0.05 * 0.6744897501960817), 0.25, 1e-9);  // another
    const MarginalDistribution wider = marginal_of(example_estimate("oxygen_saturation", 0.5, 0.07)).value();
    EXPECT_GT(std::abs(wider.probability_above(0.55) - (1.0 - normal_cdf(1.0))), slice);  // the check can fail
}

TEST(MarginalDistribution, EndsAtTheBoundsOfTheFit) {
    ParameterEstimate estimate = example_estimate("oxygen_saturation", 0.95, 0.1);
    estimate.interval_95.upper = 1.0;  // cut
    const MarginalDistribution marginal = marginal_of(estimate).value();
    EXPECT_EQ(marginal.probability_above(1.0), 0.0);
    EXPECT_EQ(marginal.probability_above(-1e-9), 1.0);
    const double whole = normal_cdf(0.5) - normal_cdf(-9.5);
    for (double x = 0.7; x < 1.0; x += 0.0101) {
        EXPECT_NEAR(marginal.probability_above(x), (normal_cdf(0.5) - normal_cdf((x - 0.95) / 0.1)) / whole, slice)
            << x;
    }
}

/// Two halves with the probabilities of their scales' shares: the density is continuous where they meet.
TEST(MarginalDistribution, OfALopsidedIntervalHasTwoScales) {
    ParameterEstimate estimate = example_estimate("bilirubin_g_per_l", 0.5, 0.05);
    estimate.interval_95.upper += estimate.interval_95.upper - 0.5;  // 0.1 above
    const MarginalDistribution marginal = marginal_of(estimate).value();
    EXPECT_NEAR(marginal.probability_above(0.5), 2.0 / 3.0, 1e-4);
    EXPECT_NEAR(marginal.probability_above(0.7), 2.0 / 3.0 * 2.0 * (1.0 - normal_cdf(2.0)), slice);
    EXPECT_NEAR(1.0 - marginal.probability_above(0.45), 1.0 / 3.0 * 2.0 * (1.0 - normal_cdf(1.0)), slice);
    // Outside the interval lie 5 %, as it says.
    EXPECT_NEAR(1.0 - marginal.probability_above(estimate.interval_95.lower) +
                    marginal.probability_above(estimate.interval_95.upper),
                0.05, 2 * slice);
}

TEST(MarginalDistribution, AtABoundIsHalfANormalDistribution) {
    ParameterEstimate estimate = example_estimate("bilirubin_g_per_l", 0.0, 0.05);
    estimate.sigma.reset();
    estimate.status = Status::at_lower_bound;
    estimate.interval_95 = {.lower = 0.0, .upper = 1.6448536269514722 * 0.05};
    const MarginalDistribution lower = marginal_of(estimate).value();
    EXPECT_NEAR(lower.probability_above(0.05), 2.0 * (1.0 - normal_cdf(1.0)), slice);
    EXPECT_NEAR(lower.probability_above(estimate.interval_95.upper), 0.1, slice);
    estimate.status = Status::at_upper_bound;
    estimate.value = 1.0;
    estimate.interval_95 = {.lower = 1.0 - 1.6448536269514722 * 0.05, .upper = 1.0};
    const MarginalDistribution upper = marginal_of(estimate).value();
    for (double x = 0.01; x < 0.2; x += 0.0101) {
        EXPECT_NEAR(upper.probability_above(1.0 - x), 1.0 - lower.probability_above(x), 1e-9);
    }
    EXPECT_GT(std::abs(upper.probability_above(0.95) - lower.probability_above(0.05)), 0.3);  // the other half
}

TEST(MarginalDistribution, OfWhatIsNotIdentifiableThereIsNone) {
    ParameterEstimate estimate = example_estimate("oxygen_saturation", 0.5, 0.05);
    estimate.status = Status::not_identifiable;
    EXPECT_FALSE(marginal_of(estimate));
    estimate.status = Status::free;
    EXPECT_TRUE(marginal_of(estimate));
    estimate.sigma.reset();
    estimate.interval_95 = estimate.bounds;  // nor of one that may be anything
    EXPECT_FALSE(marginal_of(estimate));
    for (const Status status : {Status::at_lower_bound, Status::at_upper_bound}) {
        estimate.status = status;
        EXPECT_FALSE(marginal_of(estimate));
    }
}

/// An end of the interval that was cut at a bound tells no scale: the other does.
TEST(MarginalDistribution, TakesTheScaleThatIsKnown) {
    ParameterEstimate estimate = example_estimate("oxygen_saturation", 0.95, 0.05);
    estimate.interval_95.upper = 1.0;
    estimate.sigma.reset();
    const MarginalDistribution marginal = marginal_of(estimate).value();
    const double whole = normal_cdf(1.0);
    EXPECT_NEAR(marginal.probability_above(0.95), (normal_cdf(1.0) - 0.5) / whole, slice);
}

/// What only the prior tells is the prior: half of it above the median, whatever the scale.
TEST(MarginalDistribution, UnderAPriorIsNormalInItsScore) {
    ParameterEstimate estimate = example_estimate("bilirubin_g_per_l", 0.05, 0.05 * 1.5);
    estimate.prior = LogNormalPrior{.median = 0.05, .sigma_log = 1.5};
    const auto at_score = [](double score) { return 0.05 * std::exp(1.5 * score); };
    estimate.bounds = {.lower = at_score(-8.0), .upper = at_score(8.0)};
    estimate.interval_95 = {.lower = at_score(-1.959963984540054), .upper = at_score(1.959963984540054)};
    const MarginalDistribution marginal = marginal_of(estimate).value();
    EXPECT_NEAR(marginal.probability_above(0.05), 0.5, 1e-9);  // a quantile
    EXPECT_NEAR(marginal.probability_above(0.2), 1.0 - normal_cdf(std::log(4.0) / 1.5), slice);
    EXPECT_NEAR(marginal.probability_above(0.01), normal_cdf(std::log(5.0) / 1.5), slice);
}

TEST(MarginalDistribution, OfAPosteriorIsItsQuantiles) {
    ParameterEstimate estimate = example_estimate("oxygen_saturation", 0.5, 0.05);
    estimate.quantiles = {0.2, 0.3, 0.6, 0.6, 0.9};
    const MarginalDistribution marginal = marginal_of(estimate).value();
    EXPECT_DOUBLE_EQ(marginal.probability_above(0.2), 1.0);
    EXPECT_DOUBLE_EQ(marginal.probability_above(0.25), 0.875);
    EXPECT_DOUBLE_EQ(marginal.probability_above(0.3), 0.75);
    EXPECT_DOUBLE_EQ(marginal.probability_above(0.6),
                     0.25);  // half of the probability lies up to there, a quarter at it
    EXPECT_DOUBLE_EQ(marginal.probability_above(0.75), 0.125);
    EXPECT_DOUBLE_EQ(marginal.probability_above(0.9), 0.0);
    estimate.status = Status::at_lower_bound;  // the posterior knows better
    EXPECT_DOUBLE_EQ(marginal_of(estimate)->probability_above(0.25), 0.875);
}

/// Of two normal distributions. A slice's middle stands for the slice: half a slice of error at the most, summed over
/// all slices; that of the other's quantiles, a slice.
TEST(MarginalDistribution, ComparesIndependentNormals) {
    for (const double shift : {-0.1, -0.03, 0.0, 0.02, 0.07}) {
        const MarginalDistribution a = marginal_of(example_estimate("oxygen_saturation", 0.5 + shift, 0.03)).value();
        const MarginalDistribution b = marginal_of(example_estimate("oxygen_saturation", 0.5, 0.04)).value();
        EXPECT_NEAR(a.probability_above(b), normal_cdf(shift / 0.05), 1.5 * slice) << shift;
        EXPECT_NEAR(a.probability_above(b) + b.probability_above(a), 1.0, slice) << shift;
        EXPECT_GT(std::abs(a.probability_above(b) - normal_cdf((shift + 0.02) / 0.05)), 1.5 * slice);
        EXPECT_NEAR(a.probability_above(a), 0.5, 1e-12);
    }
}

TEST(MarginalDistribution, OfAnIndexIsNormal) {
    const MarginalDistribution marginal =
        marginal_of(IndexValue{.name = index_table()[0].name, .value = 40.0, .sigma = 2.0});
    for (double z = -5.9; z < 5.9; z += 0.173) {
        EXPECT_NEAR(marginal.probability_above(40.0 + 2.0 * z), 1.0 - normal_cdf(z), slice);
    }
    EXPECT_NEAR(marginal.probability_above(40.0), 0.5, 1e-12);
}

}  // namespace
}  // namespace skinfit
