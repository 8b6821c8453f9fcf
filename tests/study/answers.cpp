#include "study/answers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/study/example_rows.hpp"

namespace skinfit {
namespace {

using test::example_estimate;
using test::example_row;

Indicator above(const std::string& quantity, double threshold) {
    return {.name = "asked",
            .quantity = quantity,
            .above = true,
            .threshold = threshold,
            .reference = {},
            .source = "the example"};
}

Indicator below_reference() {
    Indicator indicator = above("oxygen_saturation", 0.0);
    indicator.above = false;
    indicator.threshold.reset();
    indicator.reference = ReferenceSite{.same = "subject", .where = {{"site", "forearm"}}};
    return indicator;
}

LedgerRow saturated(const std::string& subject, const std::string& site, double value) {
    return example_row(subject + site, {{"subject", subject}, {"site", site}},
                       example_estimate("oxygen_saturation", value, 0.05));
}

std::vector<AnsweredRow> answers(const std::vector<Indicator>& indicators, const std::vector<LedgerRow>& rows) {
    Study study;
    study.indicators = indicators;
    return answered(study, rows);
}

TEST(Answers, BelowIsTheComplementOfAbove) {
    Indicator other = above("oxygen_saturation", 0.55);
    other.above = false;
    const IndicatorAnswer yes =
        answers({above("oxygen_saturation", 0.55), other}, {saturated("a", "", 0.5)})[0].indicators[0];
    const IndicatorAnswer no =
        answers({above("oxygen_saturation", 0.55), other}, {saturated("a", "", 0.5)})[0].indicators[1];
    EXPECT_DOUBLE_EQ(yes.probability.value() + no.probability.value(), 1.0);
    EXPECT_NEAR(*yes.probability, std::erfc(std::sqrt(0.5)) / 2.0, 1.0 / 200);
    EXPECT_EQ(yes.why_none, "");
}

TEST(Answers, OnlySpectraWithAnAnswerHaveProbabilities) {
    for (const FitStatus status : {FitStatus::pending, FitStatus::rejected, FitStatus::failed}) {
        LedgerRow row = saturated("a", "", 0.5);
        row.studied.status = status;
        const std::vector<AnsweredRow> found = answers({above("oxygen_saturation", 0.55)}, {row});
        EXPECT_FALSE(found[0].indicators[0].probability);
        EXPECT_EQ(found[0].indicators[0].why_none, name_of(status));
        EXPECT_FALSE(estimate_of(row, "oxygen_saturation")) << "a search that did not converge has no estimate";
    }
    LedgerRow row = saturated("a", "", 0.5);
    row.studied.status = FitStatus::suspect;
    EXPECT_TRUE(answers({above("oxygen_saturation", 0.55)}, {row})[0].indicators[0].probability);
}

TEST(Answers, SayWhereThePriorDecidesTheQuantityOrItsReference) {
    LedgerRow row = saturated("a", "foot", 0.5);
    LedgerRow reference = saturated("a", "forearm", 0.6);
    const std::vector<Indicator> questions = {above("oxygen_saturation", 0.55), below_reference()};
    for (const IndicatorAnswer& each : answers(questions, {row, reference})[0].indicators) {
        EXPECT_FALSE(each.decided_by_prior);
    }
    row.studied.parameters[0].decided_by_prior = true;
    for (const IndicatorAnswer& each : answers(questions, {row, reference})[0].indicators) {
        EXPECT_TRUE(each.decided_by_prior);
    }
    EXPECT_TRUE(estimate_of(row, "oxygen_saturation")->decided_by_prior);
    row.studied.parameters[0].decided_by_prior = false;
    reference.studied.parameters[0].decided_by_prior = true;
    EXPECT_FALSE(answers(questions, {row, reference})[0].indicators[0].decided_by_prior);
    EXPECT_TRUE(answers(questions, {row, reference})[0].indicators[1].decided_by_prior);
}

/// Two halves of a normal distribution of the logarithm, of 0.5 below and 1 above 30.
TEST(Answers, AQuantityOfTheTissueHasAProbabilityByItsInterval) {
    LedgerRow row = saturated("a", "", 0.5);
    const double two_sided_95 = 1.959963984540054;
    row.studied.tissue = {
        {.name = "dermal_hemoglobin_umol_per_l",
         .value = 30.0,
         .interval_95 = Bounds{30.0 * std::exp(-0.5 * two_sided_95), 30.0 * std::exp(two_sided_95)}},
        {.name = "tissue_bilirubin_mg_per_dl", .value = 0.0, .interval_95 = Bounds{0.0, two_sided_95}},
        {.name = "tissue_bilirubin_umol_per_l", .value = 1.0, .interval_95 = {}}};
    const std::vector<IndicatorAnswer> found =
        answers(
            {above("dermal_hemoglobin_umol_per_l", 30.0), above("dermal_hemoglobin_umol_per_l", 30.0 * std::exp(1.0)),
             above("tissue_bilirubin_mg_per_dl", 1.0), above("tissue_bilirubin_umol_per_l", 1.0)},
            {row})[0]
            .indicators;
    const double beyond_one_sigma = std::erfc(std::sqrt(0.5));  // of a half
    EXPECT_NEAR(found[0].probability.value(), 2.0 / 3.0, 1e-3);
    EXPECT_NEAR(found[1].probability.value(), 2.0 / 3.0 * beyond_one_sigma, 1e-3);
    EXPECT_NEAR(found[2].probability.value(), beyond_one_sigma, 1e-3);
    EXPECT_FALSE(found[3].probability);
    EXPECT_EQ(found[3].why_none, "tissue_bilirubin_umol_per_l is not identifiable");
    const std::optional<QuantityEstimate> estimate = estimate_of(row, "dermal_hemoglobin_umol_per_l");
    EXPECT_EQ(estimate->value, 30.0);
    EXPECT_EQ(estimate->interval_95->upper, row.studied.tissue[0].interval_95->upper);
    row.studied.tissue[0].quantiles = {10.0, 20.0, 40.0};
    EXPECT_DOUBLE_EQ(*answers({above("dermal_hemoglobin_umol_per_l", 30.0)}, {row})[0].indicators[0].probability, 0.25);
}

/// By Bayes's rule: a spectrum that says nothing leaves the prevalence, and the odds of any other are the likelihood
/// ratio times those of the prevalence.
TEST(Answers, APrevalenceTakesThePlaceOfWhatThePriorSays) {
    ParameterEstimate ignorant = example_estimate("bilirubin_g_per_l", 0.1, 0.05);
    ignorant.bounds = {.lower = 0.0, .upper = 1.0};
    ignorant.quantiles = {0.0, 0.25, 0.5, 0.75, 1.0};  // the uniform prior, unchanged
    Indicator asked = above("bilirubin_g_per_l", 0.2);
    asked.prevalence = 0.1;
    Indicator complement = asked;
    complement.above = false;
    complement.prevalence = 0.9;
    const auto probabilities = [&](const ParameterEstimate& estimate) {
        const std::vector<AnsweredRow> rows =
            answers({above("bilirubin_g_per_l", 0.2), asked, complement}, {example_row("a", {}, estimate)});
        return std::vector{rows[0].indicators[0].probability.value(), rows[0].indicators[1].probability.value(),
                           rows[0].indicators[2].probability.value()};
    };
    const std::vector<double> unchanged = probabilities(ignorant);
    EXPECT_NEAR(unchanged[0], 0.8, 1e-12);
    EXPECT_NEAR(unchanged[1], 0.1, 1e-12);
    EXPECT_NEAR(unchanged[2], 0.9, 1e-12);
    ParameterEstimate informed = ignorant;
    informed.quantiles = {0.0, 0.1, 0.2, 0.3, 1.0};
    informed.prior = LogNormalPrior{.median = 0.2, .sigma_log = 1.0};
    informed.bounds = {.lower = 0.0, .upper = 3.0};
    const double beyond = std::erfc(-std::log(3.0 / 0.2) / std::sqrt(2.0)) / 2.0;  // of the prior, below 3 g/L
    const double expected = (beyond - 0.5) / beyond;
    const std::vector<double> changed = probabilities(informed);
    EXPECT_NEAR(changed[0], 0.5, 1e-12);
    EXPECT_NEAR(changed[1] / (1.0 - changed[1]), (0.1 / 0.9) * (1.0 - expected) / expected, 1e-12);
    EXPECT_NEAR(changed[1] + changed[2], 1.0, 1e-12);
}

TEST(Answers, SayWhyThereIsNone) {
    LedgerRow row = saturated("a", "", 0.5);
    Indicator beyond = above("oxygen_saturation", 1.0);
    EXPECT_EQ(answers({beyond}, {row})[0].indicators[0].probability, 0.0);
    beyond.prevalence = 0.3;
    EXPECT_EQ(answers({beyond}, {row})[0].indicators[0].why_none, "the prior lies on one side of the threshold");
    EXPECT_EQ(answers({above("bilirubin_g_per_l", 0.1)}, {row})[0].indicators[0].why_none,
              "bilirubin_g_per_l is not known");
    row.studied.parameters[0].status = Status::not_identifiable;
    EXPECT_EQ(answers({above("oxygen_saturation", 0.1)}, {row})[0].indicators[0].why_none,
              "oxygen_saturation is not identifiable");
    EXPECT_EQ(answers({below_reference()}, {saturated("a", "foot", 0.4)})[0].indicators[0].why_none,
              "no reference of the same specimen");
    EXPECT_EQ(answers({below_reference()}, {saturated("a", "forearm", 0.4)})[0].indicators[0].why_none, "a reference");
}

/// P(a < b) of normals 0.1 apart, each of sigma 0.05, within the resolution of their quantiles.
TEST(Answers, AReferenceIsThatOfTheSameSpecimen) {
    const std::vector<LedgerRow> rows = {saturated("a", "foot", 0.4), saturated("a", "forearm", 0.5),
                                         saturated("b", "forearm", 0.2), saturated("b", "foot", 0.4)};
    const std::vector<AnsweredRow> found = answers({below_reference()}, rows);
    const double phi = std::erfc(-0.1 / 0.05 / 2.0) / 2.0;
    EXPECT_NEAR(found[0].indicators[0].probability.value(), phi, 1.5 / 200);
    EXPECT_NEAR(found[3].indicators[0].probability.value(), std::erfc(0.2 / 0.05 / 2.0) / 2.0, 1.5 / 200);
}

TEST(Answers, OfSeveralReferencesTheMeanCounts) {
    const std::vector<LedgerRow> one = {saturated("a", "foot", 0.4), saturated("a", "forearm", 0.45)};
    const std::vector<LedgerRow> other = {saturated("a", "foot", 0.4), saturated("a", "forearm", 0.38)};
    const std::vector<LedgerRow> both = {one[0], one[1], other[1]};
    const double mean = (answers({below_reference()}, one)[0].indicators[0].probability.value() +
                         answers({below_reference()}, other)[0].indicators[0].probability.value()) /
                        2.0;
    EXPECT_NEAR(answers({below_reference()}, both)[0].indicators[0].probability.value(), mean, 1e-15);
}

TEST(Answers, AReferenceWithoutAnAnswerIsNone) {
    for (const FitStatus status : {FitStatus::rejected, FitStatus::failed, FitStatus::pending}) {
        std::vector<LedgerRow> rows = {saturated("a", "foot", 0.4), saturated("a", "forearm", 0.5)};
        rows[1].studied.status = status;
        EXPECT_EQ(answers({below_reference()}, rows)[0].indicators[0].why_none, "no reference of the same specimen");
    }
}

TEST(Answers, WithoutAWordForTheSpecimenNothingIsTheSame) {
    std::vector<LedgerRow> rows = {saturated("", "foot", 0.4), saturated("", "forearm", 0.5)};
    EXPECT_FALSE(answers({below_reference()}, rows)[0].indicators[0].probability);
    for (LedgerRow& row : rows) row.metadata.erase(row.metadata.begin());
    EXPECT_FALSE(answers({below_reference()}, rows)[0].indicators[0].probability);
}

TEST(Answers, AnIndexIsAQuantityToo) {
    LedgerRow row = saturated("a", "", 0.5);
    row.studied.indices = {{.name = "melanin_index", .value = 40.0, .sigma = 2.0}};
    EXPECT_NEAR(answers({above("melanin_index", 42.0)}, {row})[0].indicators[0].probability.value(),
                std::erfc(std::sqrt(0.5)) / 2.0, 1.0 / 200);
    EXPECT_EQ(estimate_of(row, "melanin_index")->value, 40.0);
    EXPECT_EQ(estimate_of(row, "melanin_index")->sigma, 2.0);
    EXPECT_FALSE(estimate_of(row, "melanin_index")->interval_95);
    EXPECT_EQ(estimate_of(row, "oxygen_saturation")->interval_95->upper, row.studied.parameters[0].interval_95.upper);
    EXPECT_FALSE(estimate_of(row, "erythema_index"));
}

TEST(Answers, APosteriorIsEstimatedByItsMeanAndStandardDeviation) {
    LedgerRow row = saturated("a", "", 0.9);
    for (int k = 0; k <= 100; ++k) row.studied.parameters[0].quantiles.push_back(k / 100.0);  // uniform
    const QuantityEstimate estimate = estimate_of(row, "oxygen_saturation").value();
    constexpr double rounding = 101 * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(estimate.value, 0.5, rounding);
    EXPECT_NEAR(estimate.sigma.value(), 1.0 / std::sqrt(12.0), rounding);
}

}  // namespace
}  // namespace skinfit
