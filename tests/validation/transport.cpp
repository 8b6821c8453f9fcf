#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "validation/transport_summary.hpp"

namespace skinfit::test {
namespace {

/// A skin of 200 whose saturation is missed by `error`, half of them with bilirubin, answered as it is.
TransportFit fit(int k, double error) {
    const double saturation = 0.3 + 0.6 * (k * 37 % 200) / 200.0;
    const double bilirubin = k % 2 == 0 ? 0.0 : 0.02;
    const double melanin = 0.01 * std::exp(0.015 * k);
    const double hemoglobin = 20.0 + k;
    const auto within = [](double value, double lower, double upper) {
        return TransportFit::Estimate{.value = value, .interval_95 = Bounds{lower, upper}};
    };
    // Readings that say nothing of saturation.
    return {.name = std::to_string(k),
            .truth = {saturation, bilirubin, melanin, hemoglobin},
            .estimate = {within(saturation + error, saturation - 0.1, saturation + 0.1),
                         within(bilirubin + 0.001, 0.0, 0.05), within(2.0 * melanin, melanin, 3.0 * melanin),
                         within(hemoglobin, 1.0, 1000.0)},
            .verdict = Verdict::consistent,
            .measured = {0.3 + 0.01 * (k * 11 % 17), 0.3 + 0.01 * (k * 7 % 19), 0.4, 0.5}};
}

TransportStudy study_of(double error) {
    TransportStudy study{.cohort = "made", .wavelength_nm = {500, 550, 660, 690}, .fits = {}};
    for (int k = 0; k < 200; ++k) study.fits.push_back(fit(k, k % 4 < 2 ? error : -error));
    return study;
}

const JudgedFigure& figure(const TransportSummary& summary, std::string_view quantity, std::string_view name,
                           std::string_view spectra) {
    const auto found = std::ranges::find_if(summary.figures, [&](const JudgedFigure& each) {
        return each.quantity == quantity && each.figure == name && each.spectra == spectra;
    });
    EXPECT_NE(found, summary.figures.end()) << quantity << " " << name;
    return *found;
}

TEST(TransportSummary, PassesWhereAnswersAreGoodAndHasTheFiguresOfTheTruth) {
    const TransportSummary summary = summarised(study_of(0.05));
    EXPECT_TRUE(passes(summary)) << transport_text(summary);
    EXPECT_TRUE(transport_text(summary).starts_with("verdict: passes\n200 spectra of another physics"));
    EXPECT_EQ(summary.consistent, 200U);
    const auto value = [&](std::string_view quantity, std::string_view name, std::string_view spectra) {
        return figure(summary, quantity, name, spectra).found.value;
    };
    EXPECT_NEAR(value("oxygen_saturation", "mean_absolute_error", "without bilirubin"), 0.05, 1e-12);
    EXPECT_NEAR(value("oxygen_saturation", "bias", "with bilirubin"), 0.0, 1e-12);
    // Of 100 truths that lie evenly over 0.6, whose middle is at most 0.006 away: a quarter of the range.
    EXPECT_NEAR(value("oxygen_saturation", "constant_error", "without bilirubin"), 0.15, 0.006);
    EXPECT_EQ(value("oxygen_saturation", "coverage", "without bilirubin"), 1.0);
    EXPECT_EQ(value("dermal_bilirubin_g_per_l", "area", "darker half"), 1.0);
    EXPECT_EQ(value("dermal_bilirubin_g_per_l", "interval_below_truth", "consistent"), 0.0);
    EXPECT_NEAR(value("melanosome_fraction", "rank_correlation", "all"), 1.0, 1e-12);
    EXPECT_NEAR(value("melanosome_fraction", "log_log_slope", "all"), 1.0, 1e-9);
    EXPECT_NEAR(value("melanosome_fraction", "mean_ratio", "all"), 2.0, 1e-9);
    EXPECT_NEAR(value("dermal_hemoglobin_umol_per_l", "mean_ratio", "all"), 1.0, 1e-9);
}

TEST(TransportSummary, RegressionLeavesEachSkinOutOfItsOwn) {
    TransportStudy study = study_of(0.05);
    // One reading that is the saturation: nothing is left but the other's rounding.
    for (TransportFit& each : study.fits) each.measured[0] = std::exp(-each.truth[0]);
    const TransportSummary summary = summarised(study);
    EXPECT_NEAR(figure(summary, "oxygen_saturation", "regression_error", "without bilirubin").found.value, 0.0, 1e-9);
    EXPECT_FALSE(figure(summary, "oxygen_saturation", "mean_absolute_error", "without bilirubin").passes());
    EXPECT_FALSE(passes(summary));
    // Of noise alone, left out of its own regression a skin is predicted no better than by the constant.
    const TransportSummary blind = summarised(study_of(0.05));
    EXPECT_GT(figure(blind, "oxygen_saturation", "regression_error", "without bilirubin").found.value,
              0.95 * figure(blind, "oxygen_saturation", "constant_error", "without bilirubin").found.value);
}

TEST(TransportSummary, FailsAtWhatIsWrongAndSaysSo) {
    const auto expect = [](const TransportStudy& study, std::string_view quantity, std::string_view name,
                           std::string_view spectra) {
        const TransportSummary summary = summarised(study);
        EXPECT_FALSE(passes(summary));
        EXPECT_FALSE(figure(summary, quantity, name, spectra).passes()) << name;
        const std::string text = transport_text(summary);
        EXPECT_TRUE(text.starts_with("verdict: FAILS"));
        EXPECT_NE(text.find("FAILS", 20), std::string::npos) << "the line that fails says so";
        EXPECT_EQ(transport_json(summary)["passes"], false);
    };
    expect(study_of(0.25), "oxygen_saturation", "mean_absolute_error", "without bilirubin");
    TransportStudy study = study_of(0.05);
    for (TransportFit& each : study.fits)
        each.estimate[0]->interval_95 = Bounds{each.truth[0] - 0.1, each.truth[0] - 0.05};
    expect(study, "oxygen_saturation", "coverage", "with bilirubin");
    study = study_of(0.05);
    for (TransportFit& each : study.fits) each.estimate[1] = TransportFit::Estimate{0.005, Bounds{0.0, 0.015}};
    expect(study, "dermal_bilirubin_g_per_l", "area", "lighter half");
    expect(study, "dermal_bilirubin_g_per_l", "interval_below_truth", "consistent");
    study = study_of(0.05);
    for (TransportFit& each : study.fits) each.estimate[2]->value = std::pow(each.truth[2], 1.5);
    expect(study, "melanosome_fraction", "log_log_slope", "all");
    study = study_of(0.05);
    for (TransportFit& each : study.fits) each.estimate[3]->value = 1.0 / each.truth[3];
    expect(study, "dermal_hemoglobin_umol_per_l", "rank_correlation", "all");
}

TEST(TransportSummary, TruthsThatDifferByRoundingHaveNoOrder) {
    TransportStudy study = study_of(0.05);
    for (std::size_t k = 0; k < study.fits.size(); ++k)
        study.fits[k].truth[3] = k % 3 == 0 ? 100.0 : std::nextafter(100.0, 200.0);
    for (const JudgedFigure& each : summarised(study).figures) {
        EXPECT_FALSE(each.quantity == "dermal_hemoglobin_umol_per_l" && each.figure != "coverage") << each.figure;
    }
}

TEST(TransportSummary, WhatIsNotEstimatedIsNotJudged) {
    TransportStudy study = study_of(0.05);
    for (TransportFit& each : study.fits) each.estimate = {};
    EXPECT_TRUE(summarised(study).figures.empty());
    EXPECT_FALSE(passes(summarised(study)));
    study = study_of(0.05);
    for (std::size_t k = 0; k < 11; ++k) study.fits[k].verdict = Verdict::failed;
    EXPECT_FALSE(passes(summarised(study)));
}

}  // namespace
}  // namespace skinfit::test
