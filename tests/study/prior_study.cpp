#include <gtest/gtest.h>

#include <cmath>

#include "fit/configuration_json.hpp"
#include "study/answers.hpp"
#include "study/calibration.hpp"
#include "study/planned_study.hpp"
#include "study/spectrum_fitter.hpp"
#include "tests/study/small_cohort.hpp"
#include "tests/support/statistics.hpp"

/// A study of newborns, from their skin to the probability of jaundice: whatever kind of interval is asked for, it
/// holds the truth in 95 % of the cases, and of the newborns with a probability of 0.3 three in ten are jaundiced.
namespace skinfit {
namespace {

using test::cohort_of;
using test::passing_p_value;
using test::two_sided_p_value;
using test::without_cache;

/// Eight bands of a camera; bilirubin as the set of physiological priors has it.
Json newborns(std::size_t subjects) {
    Json cohort = Json::parse(R"({
        "name": "newborns", "seed": 3, "wavelengths": "450:660:30", "noise": 0.003,
        "model": {"incidence_deg": 8, "specular": "included"},
        "population": {
            "melanosome_fraction": {"kind": "log_normal", "median": 0.0286, "sigma_log": 0.5},
            "papillary_blood_fraction": {"kind": "log_normal", "median": 0.0118, "sigma_log": 0.6},
            "reticular_blood_fraction": {"kind": "log_normal", "median": 0.0118, "sigma_log": 0.6},
            "oxygen_saturation": {"kind": "beta", "a": 6, "b": 2},
            "bilirubin_g_per_l": {"kind": "log_normal", "median": 0.05, "sigma_log": 1.5}},
        "labels": {"jaundiced": {"parameter": "bilirubin_g_per_l", "above": 0.2}}})");
    cohort["groups"] = Json::array({{{"name", "all"}, {"subjects", subjects}}});
    return cohort;
}

/// What became of a study.
struct Outcome {
    std::size_t intervals = 0;
    std::size_t holding_the_truth = 0;
    std::size_t half_as_long_holding_it = 0;
    std::vector<PredictedCase> jaundice;
    std::size_t decided_by_prior = 0;  // of the probabilities of jaundice
};

Outcome studied(const std::string& uncertainty, std::size_t subjects) {
    const Cohort cohort = cohort_of(newborns(subjects));
    const SimulatedCohort simulated = simulate(cohort, without_cache());
    Study study;
    study.file = "study.json";
    study.fit = study_json(cohort)["fit"];
    study.fit["uncertainty"] = uncertainty;
    study.configuration = configured(default_study_configuration(), study.fit, "study.json: fit");
    study.indicators = {
        {.name = "jaundice", .quantity = "bilirubin_g_per_l", .threshold = 0.2, .reference = {}, .source = "chosen"}};
    SpectrumFitter fitter(study, without_cache());
    std::vector<LedgerRow> rows;
    Outcome outcome;
    for (const SimulatedSubject& subject : simulated.subjects) {
        Spectrum spectrum;
        spectrum.name = std::to_string(subject.number);
        spectrum.source = "simulated";
        spectrum.wavelength_nm = simulated.wavelength_nm;
        spectrum.value = subject.reading.front();
        LedgerRow row;
        row.studied = fitter.fit(spectrum);
        EXPECT_TRUE(has_answer(row.studied.status)) << row.studied.reason;
        for (const ParameterEstimate& each : row.studied.parameters) {
            const double truth = value_of(subject.values, find_parameter(each.name).value());
            const auto [lower, upper] = each.interval_95;
            ++outcome.intervals;
            if (lower <= truth && truth <= upper) ++outcome.holding_the_truth;
            if (0.5 * (lower + each.value) <= truth && truth <= 0.5 * (upper + each.value)) {
                ++outcome.half_as_long_holding_it;
            }
        }
        rows.push_back(std::move(row));
    }
    const std::vector<AnsweredRow> answers = answered(study, std::move(rows));
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const IndicatorAnswer& answer = answers[i].indicators.front();
        const bool is_jaundiced = simulated.subjects[i].values.skin.bilirubin_g_per_l > 0.2;
        outcome.jaundice.push_back({.probability = answer.probability, .is_positive = is_jaundiced});
        if (answer.decided_by_prior) ++outcome.decided_by_prior;
    }
    return outcome;
}

/// That so many of `trials` come from a probability of 95 %.
double coverage_p_value(std::size_t covered, std::size_t trials) {
    const auto n = static_cast<double>(trials);
    return two_sided_p_value((static_cast<double>(covered) - 0.95 * n) / std::sqrt(0.95 * 0.05 * n));
}

void expect_right(const Outcome& outcome) {
    EXPECT_GT(coverage_p_value(outcome.holding_the_truth, outcome.intervals), passing_p_value)
        << outcome.holding_the_truth << " of " << outcome.intervals;
    EXPECT_LT(coverage_p_value(outcome.half_as_long_holding_it, outcome.intervals), passing_p_value);
    const CalibrationAnalysis calibration = calibration_analysis(outcome.jaundice).value();
    EXPECT_EQ(calibration.without_probability, 0U);
    EXPECT_GT(calibration.positives_p_value.value(), passing_p_value)
        << calibration.observed_positives << " jaundiced, " << calibration.expected_positives << " expected";
    EXPECT_GT(calibration.spiegelhalter_p_value.value(), passing_p_value);
    // The spectra of most do not tell, and the study says so.
    EXPECT_GT(outcome.decided_by_prior, outcome.jaundice.size() / 4);
    EXPECT_LT(outcome.decided_by_prior, outcome.jaundice.size());
}

TEST(PriorStudy, IntervalsByCovarianceHoldTheTruthAndProbabilitiesComeTrue) {
    expect_right(studied("covariance", 200));
}

TEST(PriorStudy, IntervalsByProfileHoldTheTruthAndProbabilitiesComeTrue) {
    expect_right(studied("profile", 200));
}

TEST(PriorStudy, IntervalsByPosteriorHoldTheTruthAndProbabilitiesComeTrue) {
    expect_right(studied("posterior", 60));
}

}  // namespace
}  // namespace skinfit
