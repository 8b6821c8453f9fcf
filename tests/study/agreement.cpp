#include "study/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/study/peak_flow.hpp"

namespace skinfit {
namespace {

std::vector<ReferencePair> pairs_of(const std::vector<double>& estimates, const std::vector<double>& references) {
    std::vector<ReferencePair> pairs;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        pairs.push_back(
            {.estimate = estimates[i], .reference = references[i], .sigma = std::nullopt, .interval_95 = std::nullopt});
    }
    return pairs;
}

std::vector<ReferencePair> peak_flow_pairs() {
    return pairs_of(test::wright_first, test::mini_wright_first);
}

/// What [BLAND86] prints: mean difference -2.1, standard deviation 38.8, interval of the bias -22.1 to 17.8 l/min,
/// correlation 0.94; each to half a unit of its last digit, or one where the paper rounds its own rounded numbers.
TEST(Agreement, PeakFlowsAgreeAsPublished) {
    const MethodAgreement found = method_agreement(peak_flow_pairs()).value();
    EXPECT_EQ(found.pairs, 17U);
    EXPECT_NEAR(found.bias.value, -2.1, 0.05);
    EXPECT_NEAR(found.difference_sd, 38.8, 0.05);
    EXPECT_NEAR(found.bias.interval_95.lower, -22.1, 0.1);
    EXPECT_NEAR(found.bias.interval_95.upper, 17.8, 0.1);
    EXPECT_NEAR(found.pearson.value().value, 0.94, 0.005);
    std::vector<ReferencePair> other = peak_flow_pairs();
    other.front().estimate += 5.0;
    EXPECT_GT(std::abs(method_agreement(other)->bias.value + 2.1), 0.05);
}

TEST(Agreement, LimitsAreTheBiasAndTwoDeviationsWithTheErrorsOfBoth) {
    const MethodAgreement found = method_agreement(peak_flow_pairs()).value();
    const double z = 1.959963984540054;
    EXPECT_NEAR(found.upper_limit.value + found.lower_limit.value, 2.0 * found.bias.value, 1e-12);
    EXPECT_NEAR(found.upper_limit.value - found.lower_limit.value, 2.0 * z * found.difference_sd, 1e-12);
    const double bias_half = found.bias.interval_95.upper - found.bias.value;
    const double limit_half = found.upper_limit.interval_95.upper - found.upper_limit.value;
    // [BLAND99]: variances 1/n of the bias, and z^2 / (2 (n - 1)) of z standard deviations; about 3/n in [BLAND86]
    EXPECT_NEAR(std::pow(limit_half / bias_half, 2), 1.0 + z * z * 17.0 / 32.0, 1e-12);
    EXPECT_NEAR(std::pow(limit_half / bias_half, 2), 3.0, 0.05);
}

TEST(Agreement, ALineIsFoundAndLeavesNothing) {
    const MethodAgreement found = method_agreement(pairs_of({3, 5, 7, 11, 13}, {1, 2, 3, 5, 6})).value();
    EXPECT_NEAR(found.line.value().slope.value, 2.0, 1e-14);
    EXPECT_NEAR(found.line->intercept.value, 1.0, 1e-13);
    EXPECT_NEAR(found.line->slope.interval_95.upper, 2.0, 1e-6);
    EXPECT_NEAR(found.pearson.value().value, 1.0, 1e-15);
    EXPECT_LT(found.concordance.value().value, 0.7);
}

/// By hand: at 1 to 4 the slope is 7 / 5, and of the squares 10 the line leaves 10 - 49 / 5.
TEST(Agreement, TheLineHasStudentsIntervals) {
    const MethodAgreement found = method_agreement(pairs_of({2, 3, 5, 6}, {1, 2, 3, 4})).value();
    EXPECT_NEAR(found.line.value().slope.value, 1.4, 1e-14);
    EXPECT_NEAR(found.line->intercept.value, 0.5, 1e-14);
    const double student = 0.95 / std::sqrt(0.5 - 0.5 * 0.95 * 0.95);  // of two degrees of freedom, in closed form
    EXPECT_NEAR(found.line->slope.interval_95.upper - 1.4, student * std::sqrt(0.2 / 2.0 / 5.0), 1e-12);
    EXPECT_NEAR(found.line->intercept.interval_95.upper - 0.5, student * std::sqrt(0.2 / 2.0 * (0.25 + 6.25 / 5.0)),
                1e-12);
}

TEST(Agreement, FishersIntervalIsSymmetricOnItsScale) {
    const IntervalEstimate r = method_agreement(peak_flow_pairs())->pearson.value();
    EXPECT_NEAR(std::atanh(r.interval_95.upper) - std::atanh(r.value), 1.959963984540054 / std::sqrt(14.0), 1e-12);
    EXPECT_NEAR(std::atanh(r.value) - std::atanh(r.interval_95.lower), 1.959963984540054 / std::sqrt(14.0), 1e-12);
}

TEST(Agreement, ConcordanceIsThatOfLinAndDoesNotDependOnTheUnit) {
    std::vector<ReferencePair> pairs = peak_flow_pairs();
    const MethodAgreement found = method_agreement(pairs).value();
    double between = 0.0;  // sums of products about the common mean: Lin's definition by the mean square difference
    double squares = 0.0;
    double mean_estimate = 0.0;
    double mean_reference = 0.0;
    for (const ReferencePair& pair : pairs) {
        mean_estimate += pair.estimate / 17.0;
        mean_reference += pair.reference / 17.0;
    }
    for (const ReferencePair& pair : pairs) {
        squares += std::pow(pair.estimate - pair.reference, 2);
        between += std::pow(pair.estimate - mean_estimate, 2) + std::pow(pair.reference - mean_reference, 2) +
                   std::pow(mean_estimate - mean_reference, 2);
    }
    EXPECT_NEAR(found.concordance.value().value, 1.0 - squares / between, 1e-13);  // [LIN89]
    EXPECT_LE(found.concordance->value, found.pearson->value);
    for (ReferencePair& pair : pairs) pair = {1.0 - 0.01 * pair.estimate, 1.0 - 0.01 * pair.reference, {}, {}};
    const MethodAgreement scaled = method_agreement(pairs).value();
    EXPECT_NEAR(scaled.concordance->value, found.concordance->value, 1e-12);
    EXPECT_NEAR(scaled.concordance->interval_95.lower, found.concordance->interval_95.lower, 1e-12);
    EXPECT_NEAR(scaled.pearson->interval_95.upper, found.pearson->interval_95.upper, 1e-12);
}

TEST(Agreement, WithoutShiftOrScaleConcordanceIsPearsonsCorrelation) {
    const MethodAgreement found = method_agreement(pairs_of({1, 2, 3, 4, 5}, {2, 1, 4, 3, 5})).value();
    EXPECT_NEAR(found.concordance.value().value, found.pearson.value().value, 1e-15);
    const MethodAgreement same = method_agreement(pairs_of({1, 2, 3, 4}, {1, 2, 3, 4})).value();
    EXPECT_NEAR(same.concordance.value().value, 1.0, 1e-15);
    EXPECT_NEAR(same.concordance->interval_95.lower, 1.0, 1e-7);
}

/// z of 1, -2 and 3.
TEST(Agreement, ClaimedSigmasAreJudgedByChiSquare) {
    std::vector<ReferencePair> pairs = pairs_of({1.5, 1.0, 9.0, 4.0}, {1.0, 2.0, 3.0, 4.5});
    pairs[0].sigma = 0.5;
    pairs[1].sigma = 0.5;
    pairs[2].sigma = 2.0;
    const MethodAgreement found = method_agreement(pairs).value();
    const ClaimedAgreement& claimed = found.claimed.value();
    EXPECT_EQ(claimed.pairs, 3U);
    EXPECT_NEAR(claimed.mean_z, 2.0 / 3.0, 1e-15);
    EXPECT_NEAR(claimed.sd_z.value(), std::sqrt((14.0 - 4.0 / 3.0) / 2.0), 1e-14);
    EXPECT_NEAR(claimed.chi_square, 14.0, 1e-13);
    // of three degrees of freedom: erfc(sqrt(x / 2)) + sqrt(2 x / pi) exp(-x / 2)
    EXPECT_NEAR(claimed.p_value, std::erfc(std::sqrt(7.0)) + std::sqrt(28.0 / std::acos(-1.0)) * std::exp(-7.0), 1e-14);
    EXPECT_EQ(found.coverage.value().count, 1U);
    EXPECT_EQ(found.coverage->trials, 3U);
    pairs[3].interval_95 = Bounds{.lower = 3.9, .upper = 4.5};
    pairs[0].interval_95 = Bounds{.lower = 1.1, .upper = 1.9};
    EXPECT_EQ(method_agreement(pairs)->coverage->count, 1U);
    EXPECT_EQ(method_agreement(pairs)->coverage->trials, 4U);
    EXPECT_FALSE(method_agreement(peak_flow_pairs())->claimed);
    EXPECT_FALSE(method_agreement(peak_flow_pairs())->coverage);
}

TEST(Agreement, IncompletePairsAreCountedAndTooFewGiveNothing) {
    std::vector<ReferencePair> pairs = pairs_of({1, 2}, {1.5, 1});
    pairs.push_back(
        {.estimate = std::numeric_limits<double>::quiet_NaN(), .reference = 1, .sigma = {}, .interval_95 = {}});
    const MethodAgreement found = method_agreement(pairs).value();
    EXPECT_EQ(found.pairs, 2U);
    EXPECT_EQ(found.incomplete_pairs, 1U);
    EXPECT_FALSE(found.pearson);
    EXPECT_FALSE(found.concordance);
    EXPECT_FALSE(found.line);
    pairs.front().reference = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(method_agreement(pairs));
    EXPECT_FALSE(method_agreement(pairs_of({1, 2, 3, 4}, {2, 2, 2, 2}))->line);
    EXPECT_FALSE(method_agreement(pairs_of({2, 2, 2, 2}, {1, 2, 3, 4}))->pearson);
}

}  // namespace
}  // namespace skinfit
