#include "fit/tissue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/chromophores.hpp"

namespace skinfit::test {
namespace {

FittedParameter adjusted(Parameter parameter, double value, double sigma) {
    const ParameterInfo& row = info(parameter);
    return {.parameter = parameter,
            .name = std::string(row.name),
            .value = value,
            .start = value,
            .bounds = {row.lower, row.upper},
            .uncertainty = {.status = Status::free,
                            .sigma = sigma,
                            .monte_carlo_sigma = std::nullopt,
                            .interval_95 = {value - 2 * sigma, value + 2 * sigma}}};
}

/// Both blood fractions adjusted, with errors of correlation -0.5.
FitResult of_blood() {
    FitResult result;
    result.free = {adjusted(Parameter::papillary_blood_fraction, 0.02, 0.004),
                   adjusted(Parameter::reticular_blood_fraction, 0.01, 0.003)};
    result.correlation = Eigen::MatrixXd::Identity(2, 2);
    result.correlation(0, 1) = result.correlation(1, 0) = -0.5;
    result.spectra.resize(1);
    return result;
}

/// One parameter adjusted.
FitResult of_one(Parameter parameter, double value, double sigma) {
    FitResult result;
    result.free = {adjusted(parameter, value, sigma)};
    result.correlation = Eigen::MatrixXd::Identity(1, 1);
    result.spectra.resize(1);
    return result;
}

/// What a logarithm, an exponential and a few products round.
constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();

/// How much the papillary dermis, 0.02 of 0.2 cm, counts in a mean over depths weighted by exp(-z / 0.03 cm).
const double papillary = (1 - std::exp(-2.0 / 3.0)) / (1 - std::exp(-20.0 / 3.0));

TEST(Tissue, HemoglobinIsThatOfBothLayersWithTheirErrorsTogether) {
    const std::vector<TissueEstimate> estimates = tissue_estimates(of_blood());
    ASSERT_EQ(estimates.size(), 3U) << "bilirubin in blood moves with the blood";
    EXPECT_EQ(estimates[0].quantity->name, "dermal_hemoglobin_umol_per_l");
    const double blood = papillary * 0.02 + (1 - papillary) * 0.01;
    EXPECT_DOUBLE_EQ(estimates[0].value, 1e6 * blood * 150 / 64500);
    ASSERT_TRUE(estimates[0].interval_95);
    for (const double sign : {-1.0, 1.0}) {
        const double a = std::log(1 + sign * papillary * 0.008 / blood);
        const double b = std::log(1 + sign * (1 - papillary) * 0.006 / blood);
        const Bounds& interval = *estimates[0].interval_95;
        const double end = sign < 0 ? interval.lower : interval.upper;
        EXPECT_NEAR(end, estimates[0].value * std::exp(sign * std::sqrt(a * a + b * b - a * b)), roundings * end);
    }
}

TEST(Tissue, MelaninIsTheDepthOfTheEpidermis) {
    const FitResult result = of_one(Parameter::melanosome_fraction, 0.05, 0.005);
    const std::vector<TissueEstimate> estimates = tissue_estimates(result);
    ASSERT_EQ(estimates.size(), 1U);
    const Extinction extinction = Extinction::at(500, Edition::revised);
    EXPECT_DOUBLE_EQ(estimates[0].value, 0.05 * 0.01 * (80 * extinction.eumelanin + 12 * extinction.pheomelanin));
    EXPECT_NEAR(estimates[0].interval_95->lower, 0.8 * estimates[0].value, roundings);  // as of the parameter itself
    EXPECT_NEAR(estimates[0].interval_95->upper, 1.2 * estimates[0].value, roundings);
}

TEST(Tissue, BilirubinIsThatOfBloodAndTissueInBothUnits) {
    const FitResult result = of_one(Parameter::dermal_bilirubin_g_per_l, 0.02, 0.005);
    const std::vector<TissueEstimate> estimates = tissue_estimates(result);
    ASSERT_EQ(estimates.size(), 2U);
    const double blood = papillary * 0.012 + (1 - papillary) * 0.0091;
    const double g_per_l = 0.05 * blood + 0.02 * (1 - blood);
    EXPECT_DOUBLE_EQ(estimates[0].value, 100 * g_per_l);
    EXPECT_DOUBLE_EQ(estimates[1].value, 1e6 * g_per_l / 584.7);
}

TEST(Tissue, WhatIsZeroHasAnUpperLimit) {
    FitResult result = of_one(Parameter::bilirubin_g_per_l, 0.0, 0.1);
    result.free[0].uncertainty.status = Status::at_lower_bound;
    result.free[0].uncertainty.interval_95 = {0.0, 0.3};
    const std::vector<TissueEstimate> estimates = tissue_estimates(result);
    ASSERT_EQ(estimates.size(), 2U);
    EXPECT_EQ(estimates[0].value, 0.0);
    EXPECT_EQ(estimates[0].interval_95->lower, 0.0);
    EXPECT_DOUBLE_EQ(estimates[0].interval_95->upper, 100 * 0.3 * (papillary * 0.012 + (1 - papillary) * 0.0091));
}

TEST(Tissue, WithoutAnErrorThereIsNoInterval) {
    FitResult result = of_blood();
    result.free[0].uncertainty.status = Status::not_identifiable;
    for (const TissueEstimate& each : tissue_estimates(result)) EXPECT_FALSE(each.interval_95);
}

TEST(Tissue, OfDrawsTheIntervalIsTheirs) {
    FitResult result = of_one(Parameter::melanosome_fraction, 0.05, 0.005);
    constexpr int count = 4001;
    Eigen::MatrixXd draws(1, count);
    for (int k = 0; k < count; ++k) draws(0, k) = 0.02 + 0.06 * k / (count - 1);
    result.posterior =
        Posterior{.marginals = {}, .correlation = {}, .draws = draws, .chains = 1, .divergences = 0, .evaluations = 0};
    const std::vector<TissueEstimate> estimates = tissue_estimates(result);
    const double per_fraction = estimates[0].value / 0.05;
    EXPECT_NEAR(estimates[0].interval_95->lower, per_fraction * (0.02 + 0.06 * 0.025), per_fraction * 1e-9);
    EXPECT_NEAR(estimates[0].interval_95->upper, per_fraction * (0.02 + 0.06 * 0.975), per_fraction * 1e-9);
}

TEST(Tissue, NothingIsSaidOfSkinWithoutDermisNorOfOwnParameters) {
    FitResult result = of_blood();
    result.spectra.front().configuration.layers = 2;
    EXPECT_TRUE(tissue_estimates(result).empty());
    result = of_blood();
    result.configuration.own[static_cast<std::size_t>(Parameter::papillary_blood_fraction)] = true;
    EXPECT_TRUE(tissue_estimates(result).empty());
}

}  // namespace
}  // namespace skinfit::test
