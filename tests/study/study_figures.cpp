#include "study/study_figures.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "tests/study/draws.hpp"
#include "tests/study/peak_flow.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using StudyFigures = test::TemporaryFolder;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
const ComparedQuantity peak_flow = {.name = "peak flow", .unit = "l/min"};

std::vector<ScoredCase> scored_cases() {
    test::Draws draws(21);
    std::vector<ScoredCase> cases;
    for (int i = 0; i < 60; ++i) {
        const double probability = draws.uniform();
        cases.push_back({.score = probability, .is_positive = draws.uniform() < probability});
    }
    return cases;
}

std::vector<ReferencePair> pairs(std::optional<double> sigma) {
    std::vector<ReferencePair> found;
    for (std::size_t i = 0; i < test::wright_first.size(); ++i) {
        found.push_back({.estimate = test::wright_first[i],
                         .reference = test::mini_wright_first[i],
                         .sigma = sigma,
                         .interval_95 = std::nullopt});
    }
    found.push_back({.estimate = no_number, .reference = 1.0, .sigma = sigma, .interval_95 = std::nullopt});
    return found;
}

void expect_holds(const std::string& svg, const std::vector<std::string>& parts) {
    EXPECT_TRUE(svg.starts_with("<?xml"));
    EXPECT_EQ(svg.find("<script"), std::string::npos);
    for (const std::string& part : parts) EXPECT_NE(svg.find(part), std::string::npos) << part;
}

TEST_F(StudyFigures, ACurveIsShownWithItsAreaAndPoints) {
    const std::vector<ScoredCase> cases = scored_cases();
    expect_holds(svg_of(roc_figure(roc_analysis(cases), {operating_point(cases, 0.25), operating_point(cases, 0.75)},
                                   "it's a `title`")),
                 {"it's a `title`", "1 - specificity", "sensitivity", "area 0.", ", 95 %: 0.",
                  "from 0.25: ", "from 0.75: ", "chance"});
}

TEST_F(StudyFigures, ACurveThatCannotBeSaysWhy) {
    const std::vector<ScoredCase> cases = {{.score = 1.0, .is_positive = true}};
    expect_holds(svg_of(roc_figure(roc_analysis(cases), {operating_point(cases, 0.5)}, "title")),
                 {"no negative case has a score"});
}

TEST_F(StudyFigures, CalibrationIsShownWithItsTest) {
    std::vector<PredictedCase> cases;
    for (const ScoredCase& each : scored_cases()) {
        cases.push_back({.probability = each.score, .is_positive = each.is_positive});
    }
    expect_holds(svg_of(calibration_figure(calibration_analysis(cases).value(), "title")),
                 {"title", "predicted probability", "observed share", "60 cases", "Brier score 0.", "test p = 0."});
}

TEST_F(StudyFigures, AgreementIsShownWithBiasAndLimits) {
    for (const std::optional<double> sigma : {std::optional(20.0), std::optional<double>()}) {
        const MethodAgreement agreement = method_agreement(pairs(sigma)).value();
        expect_holds(svg_of(bland_altman_figure(pairs(sigma), agreement, peak_flow)),
                     {"peak flow: estimate - reference, 17 pairs", "bias (l/min) -2.12, 95 %: -22 to 17.8",
                      "upper limit of agreement (l/min) 73.9", "lower limit of agreement (l/min) -78.1"});
        const std::string svg = svg_of(reference_figure(pairs(sigma), agreement, peak_flow));
        expect_holds(svg, {"reference (l/min)", "estimate (l/min)", "slope 0.970", "concordance 0.943"});
        EXPECT_EQ(svg.find("1 sigma") != std::string::npos, sigma.has_value());
    }
}

TEST_F(StudyFigures, TwoEqualPairsAreShownToo) {
    const ReferencePair pair{.estimate = 1.0, .reference = 1.0, .sigma = std::nullopt, .interval_95 = std::nullopt};
    const MethodAgreement agreement = method_agreement({pair, pair}).value();
    expect_holds(svg_of(bland_altman_figure({pair, pair}, agreement, {.name = "saturation", .unit = ""})),
                 {"bias 0, 95 %: 0 to 0", "mean of estimate and reference"});
    expect_holds(svg_of(reference_figure({pair, pair}, agreement, {.name = "saturation", .unit = ""})), {"identity"});
}

TEST_F(StudyFigures, RepeatabilityHasARowPerParameter) {
    const ClaimedScatter claimed{.sigma = 1.0,
                                 .ratio = {.value = 1.3, .interval_95 = {.lower = 0.9, .upper = 2.1}},
                                 .chi_square = 5.0,
                                 .p_value = 0.1};
    expect_holds(svg_of(repeatability_figure({{.name = "oxygen_saturation", .claimed = claimed},
                                              {.name = "bilirubin_g_per_l", .claimed = claimed}},
                                             "title")),
                 {"oxygen_saturation", "bilirubin_g_per_l", "within-specimen standard deviation / claimed sigma"});
}

TEST_F(StudyFigures, GroupsAreCountedEvenWhenEmpty) {
    expect_holds(svg_of(group_figure({{.name = "term", .values = {0.1, 0.2, 0.25, no_number}},
                                      {.name = "preterm", .values = {}},
                                      {.name = "late", .values = {0.3}}},
                                     {.name = "bilirubin", .unit = "g/L"})),
                 {"term, n = 3", "preterm, n = 0", "late, n = 1", "bilirubin (g/L)"});
}

TEST_F(StudyFigures, PowerIsShownForEveryDesign) {
    const TwoGroupDesign design{.between_subject_sd = 0.05, .measurement_sd = 0.06};
    TwoGroupDesign repeated = design;
    repeated.repeats = 4;
    for (const std::size_t most : {3U, 500U}) {
        expect_holds(svg_of(power_figure({{.name = "once", .design = design}, {.name = "4 times", .design = repeated}},
                                         0.8, most, {.name = "bilirubin", .unit = "g/L"})),
                     {"once", "4 times", "subjects per group", "true difference of group means (g/L)", "80 %"});
    }
}

TEST_F(StudyFigures, FilesAreWhatTheirSuffixSays) {
    const StudyFigure figure = roc_figure(roc_analysis(scored_cases()), {}, "title");
    draw(figure, in_folder("a.png"));
    EXPECT_TRUE(read_file(in_folder("a.png")).starts_with("\x89PNG"));
    draw(figure, in_folder("a.pdf"));
    EXPECT_TRUE(read_file(in_folder("a.pdf")).starts_with("%PDF"));
    draw(figure, in_folder("a.svg"));
    EXPECT_EQ(read_file(in_folder("a.svg")), svg_of(figure));
    EXPECT_THROW(draw(figure, in_folder("a.jpg")), InputError);
}

}  // namespace
}  // namespace skinfit
