#include "study/repeatability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/study/peak_flow.hpp"

namespace skinfit {
namespace {

using Repeats = std::vector<RepeatedEstimate>;

Repeats repeats_of(const std::vector<std::vector<double>>& specimens, std::optional<double> sigma = {}) {
    Repeats repeats;
    for (std::size_t i = 0; i < specimens.size(); ++i) {
        for (const double estimate : specimens[i]) {
            repeats.push_back({.specimen = std::to_string(i), .estimate = estimate, .sigma = sigma});
        }
    }
    return repeats;
}

/// The ratings of four judges of six targets in [SHROUT79].
Repeats ratings() {
    return repeats_of({{9, 2, 5, 8}, {6, 1, 3, 2}, {8, 4, 6, 8}, {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}});
}

/// Published: mean squares 11.24 and 6.26, ICC(1, 1) 0.17; interval -0.13 to 0.72 by R's psych.
TEST(Repeatability, RatingsCorrelateAsPublished) {
    const RepeatabilityAnalysis found = repeatability(ratings()).value();
    const double within = std::pow(found.within_specimen_sd.value, 2);
    EXPECT_NEAR(within, 6.26, 0.005);
    EXPECT_NEAR(4.0 * found.between_specimen_variance.value() + within, 11.24, 0.005);
    EXPECT_EQ(found.within_degrees_of_freedom, 18U);
    const IntervalEstimate icc = found.intraclass_correlation.value();
    EXPECT_NEAR(icc.value, 0.17, 0.005);
    EXPECT_NEAR(icc.interval_95.lower, -0.13, 0.005);
    EXPECT_NEAR(icc.interval_95.upper, 0.72, 0.005);
    Repeats other = ratings();
    other.front().estimate = 5;
    EXPECT_GT(std::abs(repeatability(other)->intraclass_correlation->value - 0.17), 0.005);
}

/// [BLAND86]: coefficients of repeatability, twice the standard deviation of differences of two repeats about
/// zero, 43.2 and 56.4 l/min.
TEST(Repeatability, PeakFlowsRepeatAsPublished) {
    const auto coefficient = [](const std::vector<double>& first, const std::vector<double>& second) {
        std::vector<std::vector<double>> specimens;
        for (std::size_t i = 0; i < first.size(); ++i) specimens.push_back({first[i], second[i]});
        return 2.0 * std::sqrt(2.0) * repeatability(repeats_of(specimens))->within_specimen_sd.value;
    };
    EXPECT_NEAR(coefficient(test::wright_first, test::wright_second), 43.2, 0.1);
    EXPECT_NEAR(coefficient(test::mini_wright_first, test::mini_wright_second), 56.4, 0.1);
}

TEST(Repeatability, TheCorrelationIsTheShareOfTheVarianceBetweenSpecimens) {
    for (const Repeats& repeats : {ratings(), repeats_of({{1, 2}, {5, 6, 8}, {3}, {4, 4.5}})}) {
        const RepeatabilityAnalysis found = repeatability(repeats).value();
        const double between = found.between_specimen_variance.value();
        const double within = std::pow(found.within_specimen_sd.value, 2);
        EXPECT_NEAR(found.intraclass_correlation.value().value, between / (between + within), 1e-14);
    }
}

/// Expected sums of squares hold for whatever numbers of repeats: estimates are unbiased. Here for 2, 3, 1 by hand:
/// k = (6 - 14 / 6) / 2.
TEST(Repeatability, UnequalNumbersOfRepeatsHaveTheirMeanNumber) {
    const RepeatabilityAnalysis found = repeatability(repeats_of({{0, 2}, {3, 4, 5}, {12}})).value();
    EXPECT_EQ(found.specimens, 3U);
    EXPECT_EQ(found.repeated_specimens, 2U);
    EXPECT_EQ(found.repeats, 6U);
    EXPECT_EQ(found.within_degrees_of_freedom, 3U);
    EXPECT_NEAR(found.within_specimen_sd.value, std::sqrt(4.0 / 3.0), 1e-15);
    const double mean = 26.0 / 6.0;
    const double between = (2 * std::pow(1 - mean, 2) + 3 * std::pow(4 - mean, 2) + std::pow(12 - mean, 2)) / 2.0;
    EXPECT_NEAR(found.between_specimen_variance.value(), (between - 4.0 / 3.0) / ((6.0 - 14.0 / 6.0) / 2.0), 1e-12);
}

TEST(Repeatability, OrderAndUnitDoNotMatter) {
    Repeats repeats = ratings();
    const RepeatabilityAnalysis before = repeatability(repeats).value();
    std::swap(repeats.front(), repeats.back());
    std::swap(repeats[5], repeats[15]);
    for (RepeatedEstimate& repeat : repeats) repeat.estimate = 3.0 - 10.0 * repeat.estimate;
    const RepeatabilityAnalysis after = repeatability(repeats).value();
    EXPECT_NEAR(after.within_specimen_sd.value, 10.0 * before.within_specimen_sd.value, 1e-12);
    EXPECT_NEAR(after.intraclass_correlation->interval_95.upper, before.intraclass_correlation->interval_95.upper,
                1e-12);
}

TEST(Repeatability, EqualSigmasAreComparedWithThePooledDeviation) {
    const RepeatabilityAnalysis found = repeatability(repeats_of({{0, 2}, {3, 4, 5}, {12}}, 0.5)).value();
    const ClaimedScatter claimed = found.claimed.value();
    EXPECT_NEAR(claimed.sigma, 0.5, 1e-15);
    EXPECT_NEAR(claimed.ratio.value, found.within_specimen_sd.value / 0.5, 1e-14);
    EXPECT_NEAR(claimed.chi_square, 3.0 * claimed.ratio.value * claimed.ratio.value, 1e-12);
    // of three degrees of freedom: erfc(sqrt(x / 2)) + sqrt(2 x / pi) exp(-x / 2), at x = 16
    EXPECT_NEAR(claimed.p_value, std::erfc(std::sqrt(8.0)) + std::sqrt(32.0 / std::acos(-1.0)) * std::exp(-8.0), 1e-15);
    EXPECT_NEAR(claimed.ratio.interval_95.lower / claimed.ratio.value,
                found.within_specimen_sd.interval_95.lower / found.within_specimen_sd.value, 1e-14);
}

/// Of two degrees of freedom chi-square is exponential.
TEST(Repeatability, TheIntervalOfADeviationIsThatOfChiSquare) {
    const RepeatabilityAnalysis found = repeatability(repeats_of({{0, 2, 4}})).value();
    EXPECT_NEAR(found.within_specimen_sd.value, 2.0, 1e-15);
    EXPECT_NEAR(found.within_specimen_sd.interval_95.lower, 2.0 * std::sqrt(2.0 / (-2.0 * std::log(0.025))), 1e-13);
    EXPECT_NEAR(found.within_specimen_sd.interval_95.upper, 2.0 * std::sqrt(2.0 / (-2.0 * std::log(0.975))), 1e-12);
    EXPECT_FALSE(found.between_specimen_variance);
    EXPECT_FALSE(found.intraclass_correlation);
}

TEST(Repeatability, UnequalSigmasCountAsTheyScatter) {
    Repeats repeats = repeats_of({{0, 2}, {3, 4, 5}});
    for (std::size_t i = 0; i < repeats.size(); ++i) repeats[i].sigma = 1.0 + static_cast<double>(i);
    const ClaimedScatter claimed = repeatability(repeats)->claimed.value();
    EXPECT_NEAR(claimed.sigma * claimed.sigma, ((1.0 + 4.0) / 2.0 + (9.0 + 16.0 + 25.0) * 2.0 / 3.0) / 3.0, 1e-13);
    // of two values: squared difference over the sum of variances
    EXPECT_NEAR(repeatability({repeats[0], repeats[1]})->claimed->chi_square, 4.0 / (1.0 + 4.0), 1e-15);
    repeats.back().sigma = std::nullopt;
    EXPECT_FALSE(repeatability(repeats)->claimed);
}

TEST(Repeatability, SpecimensThatDifferLessThanTheirRepeatsHaveNoDeviation) {
    const RepeatabilityAnalysis found = repeatability(repeats_of({{0, 2}, {2, 0.1}})).value();
    EXPECT_LT(found.between_specimen_variance.value(), 0.0);
    EXPECT_FALSE(found.between_specimen_sd);
}

TEST(Repeatability, WithoutRepeatsThereIsNothingToSay) {
    EXPECT_FALSE(repeatability({}));
    EXPECT_FALSE(repeatability(repeats_of({{1}, {2}})));
    Repeats repeats = repeats_of({{1, 2}, {3}});
    repeats[2].estimate = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(repeatability(repeats)->without_estimate, 1U);
    EXPECT_EQ(repeatability(repeats)->specimens, 1U);
    EXPECT_FALSE(repeatability(repeats_of({{1, 1}, {3, 3}}))->intraclass_correlation);
}

}  // namespace
}  // namespace skinfit
