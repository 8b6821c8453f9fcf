#include "study/roc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/study/draws.hpp"

namespace skinfit {
namespace {

/// 40 cases with many ties.
std::vector<ScoredCase> example(std::uint64_t seed = 1) {
    test::Draws draws(seed);
    std::vector<ScoredCase> cases;
    for (int i = 0; i < 40; ++i) {
        const bool is_positive = draws.uniform() < 0.4;
        cases.push_back(
            {.score = std::round(2.0 * draws.normal() + (is_positive ? 2.0 : 0.0)), .is_positive = is_positive});
    }
    return cases;
}

double wins(double positive, double negative) {
    return positive > negative ? 1.0 : positive == negative ? 0.5 : 0.0;
}

struct ByDefinition {
    double area;
    double variance;
};

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Sample variance of `values` over their number.
double variance_of_mean(const std::vector<double>& values) {
    const double mean = mean_of(values);
    const auto count = static_cast<double>(values.size());
    double sum = 0.0;
    for (const double value : values) sum += (value - mean) * (value - mean);
    return sum / (count - 1.0) / count;
}

/// All pairs, one by one.
ByDefinition by_definition(const std::vector<ScoredCase>& cases) {
    std::vector<double> of_positive;
    std::vector<double> of_negative;
    for (const ScoredCase& each : cases) {
        std::vector<double> against;
        for (const ScoredCase& other : cases) {
            if (other.is_positive == each.is_positive) continue;
            against.push_back(each.is_positive ? wins(*each.score, *other.score) : wins(*other.score, *each.score));
        }
        (each.is_positive ? of_positive : of_negative).push_back(mean_of(against));
    }
    return {.area = mean_of(of_positive), .variance = variance_of_mean(of_positive) + variance_of_mean(of_negative)};
}

double area_under(const std::vector<OperatingPoint>& curve) {
    double area = 0.0;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double width = curve[i - 1].specificity->share() - curve[i].specificity->share();
        area += 0.5 * width * (curve[i - 1].sensitivity->share() + curve[i].sensitivity->share());
    }
    return area;
}

constexpr double rounding = 1e-13;  // of sums of some hundred terms of order 1

TEST(Roc, TheAreaIsThatOfMannAndWhitneyAndItsErrorThatOfTheStructuralComponents) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        const RocAnalysis found = roc_analysis(example(seed));
        const ByDefinition expected = by_definition(example(seed));
        ASSERT_TRUE(found.area);
        EXPECT_NEAR(found.area->value, expected.area, rounding);
        EXPECT_NEAR(found.area->standard_error.value(), std::sqrt(expected.variance), rounding);
        // and notices one case that changes sides
        std::vector<ScoredCase> other = example(seed);
        other.front().is_positive = !other.front().is_positive;
        EXPECT_GT(std::abs(by_definition(other).area - found.area->value), 1e-3);
        EXPECT_GT(std::abs(std::sqrt(by_definition(other).variance) - *found.area->standard_error), 1e-5);
    }
}

TEST(Roc, TheAreaIsUnderTheCurve) {
    const RocAnalysis found = roc_analysis(example());
    EXPECT_NEAR(found.area.value().value, area_under(found.curve), rounding);
    EXPECT_EQ(found.curve.front().true_positives + found.curve.front().false_positives, 0U);
    EXPECT_EQ(found.curve.back().false_negatives + found.curve.back().true_negatives, 0U);
    EXPECT_TRUE(std::isinf(found.curve.front().threshold));
    std::vector<OperatingPoint> without_one = found.curve;
    without_one.erase(without_one.begin() + 5);
    EXPECT_GT(std::abs(area_under(without_one) - found.area->value), rounding);
}

TEST(Roc, EveryPointOfTheCurveIsThatOfItsThreshold) {
    const std::vector<ScoredCase> cases = example();
    const RocAnalysis found = roc_analysis(cases);
    for (const OperatingPoint& point : found.curve) {
        const OperatingPoint direct = operating_point(cases, point.threshold);
        EXPECT_EQ(direct.true_positives, point.true_positives);
        EXPECT_EQ(direct.false_positives, point.false_positives);
        EXPECT_EQ(direct.true_negatives, point.true_negatives);
        EXPECT_EQ(direct.false_negatives, point.false_negatives);
        EXPECT_EQ(direct.true_positives + direct.false_negatives, found.positives);
        EXPECT_EQ(direct.true_negatives + direct.false_positives, found.negatives);
        EXPECT_EQ(direct.sensitivity->count, direct.true_positives);
        EXPECT_EQ(direct.specificity->count, direct.true_negatives);
    }
}

TEST(Roc, IncreasingTransformsChangeNothingDecreasingOnesAndOppositeLabelsMirror) {
    const std::vector<ScoredCase> cases = example();
    const RocArea area = roc_analysis(cases).area.value();
    std::vector<ScoredCase> transformed = cases;
    std::vector<ScoredCase> mirrored = cases;
    std::vector<ScoredCase> relabelled = cases;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        transformed[i].score = std::exp(*cases[i].score);
        mirrored[i].score = -*cases[i].score;
        relabelled[i].is_positive = !cases[i].is_positive;
    }
    EXPECT_EQ(roc_analysis(transformed).area->value, area.value);
    EXPECT_EQ(roc_analysis(transformed).area->standard_error, area.standard_error);
    for (const std::vector<ScoredCase>& opposite : {mirrored, relabelled}) {
        const RocArea other = roc_analysis(opposite).area.value();
        EXPECT_NEAR(other.value, 1.0 - area.value, rounding);
        EXPECT_NEAR(*other.standard_error, *area.standard_error, rounding);
        EXPECT_NEAR(other.interval_95.lower, 1.0 - area.interval_95.upper, rounding);
        EXPECT_NEAR(other.interval_95.upper, 1.0 - area.interval_95.lower, rounding);
    }
}

TEST(Roc, TheIntervalIsSymmetricOnTheLogitScale) {
    const RocArea area = roc_analysis(example()).area.value();
    const auto logit = [](double share) { return std::log(share / (1.0 - share)); };
    EXPECT_EQ(area.rule, RocIntervalRule::logit);
    EXPECT_NEAR(logit(area.interval_95.upper) + logit(area.interval_95.lower), 2.0 * logit(area.value), 1e-12);
    EXPECT_NEAR((logit(area.interval_95.upper) - logit(area.value)) * area.value * (1.0 - area.value),
                1.959963984540054 * *area.standard_error, 1e-12);
}

std::vector<ScoredCase> scored(const std::vector<double>& positives, const std::vector<double>& negatives) {
    std::vector<ScoredCase> cases;
    for (const double score : positives) cases.push_back({.score = score, .is_positive = true});
    for (const double score : negatives) cases.push_back({.score = score, .is_positive = false});
    return cases;
}

TEST(Roc, AllInOrderLeavesWhatAsManyPairsInOrderLeave) {
    const RocArea area = roc_analysis(scored({4, 5, 6}, {1, 2, 2, 3})).area.value();
    EXPECT_EQ(area.value, 1.0);
    EXPECT_EQ(area.rule, RocIntervalRule::separated);
    EXPECT_EQ(area.interval_95.upper, 1.0);
    EXPECT_NEAR(std::pow(area.interval_95.lower, 3), 0.025, 1e-15);
    const RocArea mirrored = roc_analysis(scored({1, 2, 3}, {4, 4, 5, 6})).area.value();
    EXPECT_EQ(mirrored.value, 0.0);
    EXPECT_EQ(mirrored.interval_95.lower, 0.0);
    EXPECT_NEAR(mirrored.interval_95.upper, 1.0 - area.interval_95.lower, 1e-15);
}

TEST(Roc, WithoutAnErrorTheIntervalIsThatOfHoeffding) {
    const RocArea single = roc_analysis(scored({2.5}, {1, 2, 3})).area.value();
    EXPECT_EQ(single.rule, RocIntervalRule::hoeffding);
    EXPECT_FALSE(single.standard_error);
    EXPECT_EQ(single.interval_95.lower, 0.0);
    EXPECT_EQ(single.interval_95.upper, 1.0);
    const RocArea tied = roc_analysis(scored(std::vector<double>(50, 1.0), std::vector<double>(60, 1.0))).area.value();
    EXPECT_EQ(tied.value, 0.5);
    EXPECT_EQ(tied.standard_error, 0.0);
    EXPECT_NEAR(2.0 * std::exp(-2.0 * 50 * std::pow(0.5 - tied.interval_95.lower, 2)), 0.05, 1e-15);
}

TEST(Roc, CasesWithoutAScoreAreCounted) {
    std::vector<ScoredCase> cases = example();
    const RocAnalysis before = roc_analysis(cases);
    cases.push_back({.score = std::nullopt, .is_positive = true});
    cases.push_back({.score = std::numeric_limits<double>::quiet_NaN(), .is_positive = false});
    cases.push_back({.score = std::nullopt, .is_positive = false});
    const RocAnalysis found = roc_analysis(cases);
    EXPECT_EQ(found.positives_without_score, 1U);
    EXPECT_EQ(found.negatives_without_score, 2U);
    EXPECT_EQ(found.positives, before.positives);
    EXPECT_EQ(found.negatives, before.negatives);
    EXPECT_EQ(found.area->value, before.area->value);
}

TEST(Roc, OneClassHasNoAreaAndAReason) {
    EXPECT_EQ(roc_analysis(scored({1, 2}, {})).why_no_area, "no negative case has a score");
    EXPECT_EQ(roc_analysis(scored({}, {1, 2})).why_no_area, "no positive case has a score");
    EXPECT_EQ(roc_analysis({}).why_no_area, "no case has a score");
    EXPECT_FALSE(roc_analysis(scored({1, 2}, {})).area);
    EXPECT_EQ(roc_analysis(example()).why_no_area, "");
    const OperatingPoint point = operating_point(scored({1, 2}, {}), 1.5);
    EXPECT_EQ(point.sensitivity->count, 1U);
    EXPECT_FALSE(point.specificity);
}

/// [WILSON27]'s ends solve |share - p| = z sqrt(p (1 - p) / n).
TEST(ProportionInterval, ItsEndsAreWilsons) {
    for (const std::size_t count : {0U, 1U, 7U, 19U, 20U}) {
        const Proportion found = proportion(count, 20);
        for (const double p : {found.interval_95.lower, found.interval_95.upper}) {
            EXPECT_NEAR(std::pow(found.share() - p, 2), std::pow(1.959963984540054, 2) * p * (1.0 - p) / 20, 1e-15);
        }
        EXPECT_LE(found.interval_95.lower, found.share());
        EXPECT_GE(found.interval_95.upper, found.share());
    }
    EXPECT_EQ(proportion(0, 20).interval_95.lower, 0.0);
    EXPECT_EQ(proportion(20, 20).interval_95.upper, 1.0);
}

std::vector<double> example_probabilities() {
    test::Draws draws(5);
    std::vector<double> probabilities;
    for (int i = 0; i < 12; ++i) probabilities.push_back(std::round(8.0 * draws.uniform()) / 8.0);
    return probabilities;
}

/// Of pairs in order and of pairs, expected over labels.
double expected_by_definition(const std::vector<double>& p) {
    double in_order = 0.0;
    double pairs = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        for (std::size_t j = 0; j < p.size(); ++j) {
            if (i == j) continue;
            in_order += p[i] * (1.0 - p[j]) * wins(p[i], p[j]);
            pairs += p[i] * (1.0 - p[j]);
        }
    }
    return in_order / pairs;
}

/// The linear part of (pairs in order - area x pairs) in the labels, differentiated by each probability.
double deviation_by_definition(const std::vector<double>& p) {
    const double area = expected_by_definition(p);
    double variance = 0.0;
    double pairs = 0.0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        double slope = 0.0;
        for (std::size_t j = 0; j < p.size(); ++j) {
            if (j == k) continue;
            slope += (1.0 - p[j]) * (wins(p[k], p[j]) - area) - p[j] * (wins(p[j], p[k]) - area);
            pairs += p[k] * (1.0 - p[j]);
        }
        variance += p[k] * (1.0 - p[k]) * slope * slope;
    }
    return std::sqrt(variance) / pairs;
}

TEST(ExpectedRoc, TheAreaIsThatOfAllPairs) {
    const std::vector<double> probabilities = example_probabilities();
    const ExpectedRocArea found = expected_roc_area(probabilities).value();
    EXPECT_NEAR(found.value, expected_by_definition(probabilities), rounding);
    EXPECT_NEAR(found.standard_deviation, deviation_by_definition(probabilities), rounding);
    std::vector<double> other = probabilities;
    other[3] += 0.01;
    EXPECT_GT(std::abs(expected_by_definition(other) - found.value), 1e-4);
}

TEST(ExpectedRoc, KnowsTheLimits) {
    EXPECT_EQ(expected_roc_area({0.0, 0.0, 1.0})->value, 1.0);
    EXPECT_EQ(expected_roc_area({0.0, 0.0, 1.0})->standard_deviation, 0.0);
    EXPECT_EQ(expected_roc_area(std::vector<double>(7, 0.25))->value, 0.5);
    EXPECT_FALSE(expected_roc_area({0.0, 0.0}));
    EXPECT_FALSE(expected_roc_area({1.0}));
    EXPECT_FALSE(expected_roc_area({0.5}));
    EXPECT_FALSE(expected_roc_area({}));
}

}  // namespace
}  // namespace skinfit
