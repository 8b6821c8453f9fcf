#include "study/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/study/draws.hpp"

namespace skinfit {
namespace {

std::vector<PredictedCase> example() {
    test::Draws draws(3);
    std::vector<PredictedCase> cases;
    for (int i = 0; i < 103; ++i) {
        const double probability = std::round(50.0 * draws.uniform()) / 50.0;
        cases.push_back({.probability = probability, .is_positive = draws.uniform() < probability});
    }
    return cases;
}

TEST(Calibration, BinsHoldEveryCaseOnceInOrder) {
    const std::vector<PredictedCase> cases = example();
    const CalibrationAnalysis found = calibration_analysis(cases, 10).value();
    std::size_t trials = 0;
    std::size_t positives = 0;
    double sum = 0.0;
    double last = -1.0;
    for (const CalibrationBin& bin : found.bins) {
        EXPECT_GT(bin.lowest_probability, last);  // equal probabilities stay together
        EXPECT_LE(bin.lowest_probability, bin.mean_probability);
        EXPECT_LE(bin.mean_probability, bin.highest_probability);
        last = bin.highest_probability;
        trials += bin.observed.trials;
        positives += bin.observed.count;
        sum += bin.mean_probability * static_cast<double>(bin.observed.trials);
    }
    EXPECT_EQ(trials, cases.size());
    EXPECT_EQ(positives, found.observed_positives);
    EXPECT_NEAR(sum, found.expected_positives, 1e-12);
}

TEST(Calibration, DifferentProbabilitiesGiveBinsOfEqualCount) {
    std::vector<PredictedCase> cases;
    for (int i = 0; i < 30; ++i) cases.push_back({.probability = (i * 7 % 30) / 30.0, .is_positive = i % 2 == 0});
    const CalibrationAnalysis found = calibration_analysis(cases, 10).value();
    ASSERT_EQ(found.bins.size(), 10U);
    for (const CalibrationBin& bin : found.bins) EXPECT_EQ(bin.observed.trials, 3U);
    EXPECT_EQ(calibration_analysis(cases, 50)->bins.size(), 30U);
    const std::vector<PredictedCase> equal(20, {.probability = 0.25, .is_positive = true});
    EXPECT_EQ(calibration_analysis(equal, 10)->bins.size(), 1U);
}

/// Two cases of 0.2 that come true once: what each sum is can be seen.
TEST(Calibration, TheScoreAndItsTestFollowFromTheirDefinition) {
    const CalibrationAnalysis found =
        calibration_analysis({{.probability = 0.2, .is_positive = true}, {.probability = 0.2, .is_positive = false}})
            .value();
    EXPECT_NEAR(found.brier_score, (0.64 + 0.04) / 2, 1e-15);
    EXPECT_NEAR(found.expected_brier_score, 0.16, 1e-15);
    // (0.8 - 0.2) 0.6 over 0.6 sqrt(2 0.16)
    EXPECT_NEAR(found.spiegelhalter_z.value(), 0.6 / std::sqrt(0.32), 1e-14);
    EXPECT_NEAR(found.spiegelhalter_p_value.value(), std::erfc(0.6 / std::sqrt(0.64)), 1e-14);
    EXPECT_NEAR(found.expected_positives, 0.4, 1e-15);
    EXPECT_NEAR(found.expected_positives_sd, std::sqrt(0.32), 1e-15);
    EXPECT_NEAR(found.positives_p_value.value(), std::erfc(0.6 / std::sqrt(0.64)), 1e-14);
}

/// z is the excess of the Brier score over its expectation, in standard deviations.
TEST(Calibration, ZHasTheSignOfTheExcessOfTheScore) {
    std::vector<PredictedCase> extreme = example();
    for (PredictedCase& each : extreme) each.probability = *each.probability < 0.5 ? 0.01 : 0.99;
    std::vector<PredictedCase> timid = example();
    for (PredictedCase& each : timid) each.probability = 0.5 + 0.1 * (*each.probability - 0.5);
    const CalibrationAnalysis too_extreme = calibration_analysis(extreme).value();
    const CalibrationAnalysis too_timid = calibration_analysis(timid).value();
    EXPECT_GT(too_extreme.brier_score, too_extreme.expected_brier_score);
    EXPECT_GT(too_extreme.spiegelhalter_z.value(), 0.0);
    EXPECT_LT(too_timid.brier_score, too_timid.expected_brier_score);
    EXPECT_LT(too_timid.spiegelhalter_z.value(), 0.0);
}

TEST(Calibration, OppositeLabelsWithOppositeProbabilitiesAreTheSame) {
    std::vector<PredictedCase> mirrored = example();
    for (PredictedCase& each : mirrored) {
        each = {.probability = 1.0 - *each.probability, .is_positive = !each.is_positive};
    }
    const CalibrationAnalysis one = calibration_analysis(example()).value();
    const CalibrationAnalysis other = calibration_analysis(mirrored).value();
    EXPECT_NEAR(one.brier_score, other.brier_score, 1e-13);
    EXPECT_NEAR(one.spiegelhalter_z.value(), other.spiegelhalter_z.value(), 1e-12);
}

TEST(Calibration, CertaintyThatComesTrueCannotBeTestedAndThatIsRefutedIsImpossible) {
    const CalibrationAnalysis right =
        calibration_analysis({{.probability = 1.0, .is_positive = true}, {.probability = 0.0, .is_positive = false}})
            .value();
    EXPECT_FALSE(right.spiegelhalter_z);
    EXPECT_FALSE(right.positives_p_value);
    const CalibrationAnalysis wrong = calibration_analysis({{.probability = 1.0, .is_positive = false}}).value();
    EXPECT_EQ(wrong.spiegelhalter_p_value, 0.0);
    EXPECT_EQ(wrong.positives_p_value, 0.0);
}

TEST(Calibration, CasesWithoutAProbabilityAreCounted) {
    std::vector<PredictedCase> cases = example();
    const std::size_t complete = cases.size();
    cases.push_back({.probability = std::nullopt, .is_positive = true});
    cases.push_back({.probability = std::numeric_limits<double>::quiet_NaN(), .is_positive = true});
    const CalibrationAnalysis found = calibration_analysis(cases).value();
    EXPECT_EQ(found.cases, complete);
    EXPECT_EQ(found.without_probability, 2U);
    EXPECT_FALSE(calibration_analysis({{.probability = std::nullopt, .is_positive = true}}));
}

}  // namespace
}  // namespace skinfit
