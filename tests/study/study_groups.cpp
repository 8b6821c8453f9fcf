#include "study/study_groups.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "study/study_assessment.hpp"
#include "tests/study/example_ledger.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

using test::example_estimate;
using test::example_row;
using test::refusal_of;

LedgerRow saturated(const std::string& name, const Metadata& metadata, double value, double sigma = 0.05) {
    return example_row(name, metadata, example_estimate("oxygen_saturation", value, sigma));
}

LedgerRow with_status(const std::string& name, FitStatus status, const std::string& reason,
                      const std::string& verdict = "") {
    LedgerRow row = saturated(name, {{"site", "arm"}}, 0.5);
    row.studied.status = status;
    row.studied.reason = reason;
    row.studied.verdict = verdict;
    return row;
}

std::vector<AnsweredRow> plain(const std::vector<LedgerRow>& rows) {
    return answered(Study(), rows);
}

TEST(StudyGroups, ShareTheirWords) {
    Study study;
    study.group_by = {"site", "visit"};
    const std::vector<AnsweredRow> rows = plain(
        {saturated("1", {{"site", "arm"}, {"visit", "2"}}, 0.5), saturated("2", {{"site", "leg"}}, 0.6),
         saturated("3", {{"visit", "2"}, {"site", "arm"}}, 0.7), with_status("4", FitStatus::failed, "x: y (z); w")});
    const std::vector<StudyGroup> groups = groups_of(study, rows);
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0].name, "arm, 2");
    EXPECT_EQ(groups[1].name, "leg, no visit");
    EXPECT_EQ(groups[2].name, "arm, no visit");
    ASSERT_EQ(groups[0].rows.size(), 2U);
    EXPECT_EQ(groups[0].rows[1]->row.key.name, "3");
    EXPECT_TRUE(groups[2].rows.empty()) << "without an answer";
    EXPECT_EQ(groups[2].counts[static_cast<std::size_t>(FitStatus::failed)], 1U);
    const std::vector<StudyGroup> all = groups_of(Study(), rows);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].name, "all");
    EXPECT_EQ(all[0].rows.size(), 3U);
}

TEST(StudyGroups, SummariesAreMomentsAndMedians) {
    std::vector<LedgerRow> rows = {saturated("1", {}, 0.1, 0.01), saturated("2", {}, 0.2, 0.02),
                                   saturated("3", {}, 0.6, 0.05)};
    const std::vector<AnsweredRow> three = plain(rows);
    const GroupSummary summary = summary_of(groups_of(Study(), three)[0], "oxygen_saturation").value();
    EXPECT_EQ(summary.spectra, 3U);
    EXPECT_NEAR(summary.mean, 0.3, 1e-15);
    EXPECT_NEAR(summary.sd, std::sqrt((0.04 + 0.01 + 0.09) / 2.0), 1e-15);
    EXPECT_EQ(summary.median, 0.2);
    EXPECT_EQ(summary.median_sigma, 0.02);
    rows.push_back(saturated("4", {}, 0.4));
    rows[3].studied.parameters[0].sigma.reset();
    const std::vector<AnsweredRow> four = plain(rows);
    EXPECT_NEAR(summary_of(groups_of(Study(), four)[0], "oxygen_saturation")->median, 0.3, 1e-15);
    EXPECT_EQ(summary_of(groups_of(Study(), four)[0], "oxygen_saturation")->median_sigma, 0.02);
    const std::vector<AnsweredRow> one = plain({rows[3]});
    const GroupSummary alone = summary_of(groups_of(Study(), one)[0], "oxygen_saturation").value();
    EXPECT_TRUE(std::isnan(alone.sd));
    EXPECT_TRUE(std::isnan(alone.median_sigma));
    EXPECT_FALSE(summary_of(groups_of(Study(), one)[0], "melanin_index"));
}

TEST(StudyGroups, QuantitiesOfTheTissueAreSummarisedAndSplitsCounted) {
    std::vector<LedgerRow> rows = {saturated("1", {}, 0.1), saturated("2", {}, 0.2)};
    rows[0].studied.parameters[0].split_by_model = true;
    for (LedgerRow& row : rows) {
        const double value = 10.0 * static_cast<double>(&row - rows.data() + 1);
        row.studied.tissue = {
            {.name = "tissue_bilirubin_mg_per_dl", .value = value, .interval_95 = Bounds{value - 1.0, value + 1.0}}};
    }
    const std::vector<AnsweredRow> two = plain(rows);
    const std::vector<StudyGroup> groups = groups_of(Study(), two);
    EXPECT_EQ(summary_of(groups[0], "oxygen_saturation")->split_by_model, 1U);
    EXPECT_EQ(summary_of(groups[0], "tissue_bilirubin_mg_per_dl")->mean, 15.0);
    EXPECT_EQ(quantities_in(two), (std::vector<std::string>{"oxygen_saturation", "tissue_bilirubin_mg_per_dl"}));
    EXPECT_EQ(unit_of("tissue_bilirubin_mg_per_dl"), "mg/dL");
}

TEST(StudyGroups, QuantitiesAreThoseOfSpectraWithAnAnswer) {
    std::vector<LedgerRow> rows = {saturated("1", {}, 0.5), with_status("2", FitStatus::failed, "x")};
    rows[0].studied.indices = {{.name = "melanin_index", .value = 40, .sigma = 1}};
    rows[0].studied.parameters.insert(rows[0].studied.parameters.begin(),
                                      example_estimate("bilirubin_g_per_l", 0.1, 0.01));
    rows[1].studied.parameters = {example_estimate("melanosome_fraction", 0.5, 0.1)};
    EXPECT_EQ(quantities_in(plain(rows)),
              (std::vector<std::string>{"oxygen_saturation", "bilirubin_g_per_l", "melanin_index"}));
    EXPECT_EQ(unit_of("bilirubin_g_per_l"), "g/L");
    EXPECT_EQ(unit_of("individual_typology_angle_deg"), "deg");
    EXPECT_EQ(unit_of("melanin_index"), "");
}

TEST(StudyGroups, RepeatsShareASpecimen) {
    Study study;
    study.repeats_of = "subject";
    const std::vector<AnsweredRow> rows =
        plain({saturated("1", {{"subject", "a"}}, 0.5), saturated("2", {{"subject", ""}}, 0.6), saturated("3", {}, 0.7),
               with_status("4", FitStatus::failed, "x"), saturated("5", {{"subject", "a"}}, 0.4, 0.02)});
    const std::vector<RepeatedEstimate> repeats = repeats_of(study, rows, "oxygen_saturation");
    ASSERT_EQ(repeats.size(), 2U);
    EXPECT_EQ(repeats[1].specimen, "a");
    EXPECT_EQ(repeats[1].estimate, 0.4);
    EXPECT_EQ(repeats[1].sigma, 0.02);
}

TEST(StudyReasons, AreCountedByTheirFirstWords) {
    const std::vector<ReasonCount> reasons = reasons_in(
        plain({with_status("1", FitStatus::suspect, "AT BOUND: a is 0; free it | MISFIT: chi2 is large", "suspect"),
               with_status("2", FitStatus::suspect, "AT BOUND: b is 1; free it | AT BOUND: c is 0; free it", "suspect"),
               with_status("3", FitStatus::rejected, "spikes: 1 reading lies beyond both neighbours"),
               with_status("4", FitStatus::failed, "a.csv: cannot be read (No such file); check the path"),
               with_status("5", FitStatus::failed, "b.csv: cannot be read (Permission denied); check the path"),
               with_status("6", FitStatus::failed, "c.csv: cannot be read (No such file); check the path"),
               with_status("7", FitStatus::failed, "NOT CONVERGED: after 100 steps; allow more", "failed"),
               with_status("8", FitStatus::fitted, ""), with_status("9", FitStatus::pending, "")}));
    ASSERT_EQ(reasons.size(), 5U);
    EXPECT_EQ(reasons[0].reason, "cannot be read");
    EXPECT_EQ(reasons[0].status, FitStatus::failed);
    EXPECT_EQ(reasons[0].spectra, 3U);
    EXPECT_EQ(reasons[0].example, "a.csv 4: a.csv: cannot be read (No such file); check the path");
    EXPECT_EQ(reasons[1].reason, "AT BOUND");
    EXPECT_EQ(reasons[1].spectra, 2U) << "twice for one spectrum counts once";
    EXPECT_EQ(reasons[2].reason, "MISFIT");
    EXPECT_EQ(reasons[3].reason, "spikes");
    EXPECT_EQ(reasons[4].reason, "NOT CONVERGED");
}

class Assessed : public testing::Test {
protected:
    Assessed() {
        study.indicators = {{.name = "low",
                             .quantity = "oxygen_saturation",
                             .above = false,
                             .threshold = 0.5,
                             .reference = {},
                             .source = "the example"}};
        study.assessments = {
            {.name = "low", .is_indicator = true, .metadata = "ill", .positive = "yes", .thresholds = {0.25, 0.75}},
            {.name = "oxygen_saturation", .is_indicator = false, .metadata = "oximeter", .positive = {}}};
    }
    [[nodiscard]] std::vector<AnsweredRow> rows() const {
        std::vector<LedgerRow> all = {saturated("1", {{"ill", "yes"}, {"oximeter", "0.31"}}, 0.3),
                                      saturated("2", {{"ill", "no"}, {"oximeter", "0.68"}}, 0.7),
                                      saturated("3", {{"ill", "yes"}, {"oximeter", ""}}, 0.5),
                                      saturated("4", {{"ill", ""}}, 0.1),
                                      saturated("5", {{"ill", "yes"}, {"oximeter", "0.2"}}, 0.2)};
        all[4].studied.status = FitStatus::failed;
        return answered(study, all);
    }
    Study study;
};

TEST_F(Assessed, CasesAreSpectraWithALabel) {
    const std::vector<PredictedCase> cases = cases_of(study, study.assessments[0], rows());
    ASSERT_EQ(cases.size(), 4U);
    EXPECT_TRUE(cases[0].is_positive);
    EXPECT_FALSE(cases[1].is_positive);
    EXPECT_NEAR(cases[2].probability.value(), 0.5, 1e-4);
    EXPECT_FALSE(cases[3].probability) << "its search did not converge";
    const IndicatorAssessment found = assessed(study, study.assessments[0], rows());
    EXPECT_EQ(found.roc.positives, 2U);
    EXPECT_EQ(found.roc.negatives, 1U);
    EXPECT_EQ(found.roc.positives_without_score, 1U);
    EXPECT_EQ(found.roc.area->value, 1.0);
    ASSERT_EQ(found.points.size(), 2U);
    EXPECT_EQ(found.points[0].true_positives, 2U);
    EXPECT_EQ(found.points[1].true_positives, 1U);
    EXPECT_EQ(found.calibration->cases, 3U);
}

TEST_F(Assessed, PairsAreSpectraWithAReferenceValue) {
    const std::vector<ReferencePair> pairs = pairs_of(study.assessments[1], rows());
    ASSERT_EQ(pairs.size(), 3U);
    EXPECT_EQ(pairs[0].estimate, 0.3);
    EXPECT_EQ(pairs[0].reference, 0.31);
    EXPECT_EQ(pairs[0].sigma, 0.05);
    EXPECT_TRUE(pairs[0].interval_95);
    EXPECT_TRUE(std::isnan(pairs[2].estimate)) << "its search did not converge";
    EXPECT_EQ(method_agreement(pairs)->incomplete_pairs, 1U);
}

TEST_F(Assessed, AQuantityOfTheTissueIsComparedByItsInterval) {
    std::vector<LedgerRow> rows = {saturated("1", {{"bilirubin", "11"}}, 0.1),
                                   saturated("2", {{"bilirubin", "25"}}, 0.2)};
    for (LedgerRow& row : rows) {
        row.studied.tissue = {{.name = "tissue_bilirubin_mg_per_dl", .value = 12.0, .interval_95 = Bounds{8.0, 20.0}}};
    }
    const Assessment assessment{
        .name = "tissue_bilirubin_mg_per_dl", .is_indicator = false, .metadata = "bilirubin", .positive = {}};
    const std::vector<ReferencePair> pairs = pairs_of(assessment, plain(rows));
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[1].estimate, 12.0);
    EXPECT_EQ(pairs[1].reference, 25.0);
    const MethodAgreement agreement = method_agreement(pairs).value();
    EXPECT_EQ(agreement.coverage->count, 1U);
    EXPECT_EQ(agreement.coverage->trials, 2U);
}

TEST_F(Assessed, AReferenceValueIsANumber) {
    for (const std::string word : {"high", "1,5"}) {
        const std::vector<AnsweredRow> bad = plain({saturated("1", {{"oximeter", word}}, 0.3)});
        EXPECT_EQ(refusal_of([&] { (void)pairs_of(study.assessments[1], bad); }),
                  "a.csv 1: \"oximeter\" is \"" + word +
                      "\" (it is the reference value of oxygen_saturation, a number); correct it in the manifest, or "
                      "leave the cell empty");
    }
}

TEST_F(Assessed, AMissingReferenceValueIsNone) {
    for (const std::string word : {"", "NA", "nan", "-9999"}) {
        const std::vector<AnsweredRow> without = plain({saturated("1", {{"oximeter", word}}, 0.3)});
        EXPECT_TRUE(pairs_of(study.assessments[1], without).empty()) << word;
    }
}

TEST_F(Assessed, JsonHoldsAllAssessments) {
    const Json json = assessments_json(study, rows());
    ASSERT_EQ(json.size(), 2U);
    EXPECT_EQ(json[0]["indicator"], "low");
    EXPECT_EQ(json[0]["positives"], 2);
    EXPECT_EQ(json[0]["area"]["value"], 1.0);
    EXPECT_EQ(json[1]["quantity"], "oxygen_saturation");
    EXPECT_EQ(json[1]["agreement"]["pairs"], 2);
    EXPECT_NEAR(json[1]["agreement"]["bias"]["value"].get<double>(), 0.005, 1e-15);
}

}  // namespace
}  // namespace skinfit
