#include <gtest/gtest.h>

#include <cmath>

#include "fit/configuration_json.hpp"
#include "fit/critical_values.hpp"
#include "fit/fit.hpp"
#include "fit/parameter_words.hpp"
#include "fit/prior.hpp"
#include "fit/report.hpp"
#include "tests/fit/synthetic.hpp"

/// What a fit says of a parameter of which its prior knows more than the spectrum.
namespace skinfit::test {
namespace {

Configuration stated(const std::string& text) {
    return configured_by_text(quick_configuration(), text, "test.json");
}

/// A spectrum of twelve wavelengths that tells next to nothing, fitted as `text` says.
FitResult uninformed(const std::string& text, const std::string& uncertainty) {
    const Configuration configuration =
        configured_by_text(stated(text), R"({"uncertainty": ")" + uncertainty + "\"}", "test.json");
    Spectrum spectrum = modelled_spectrum(quick_configuration(), grid_nm(400, 700, 25));
    spectrum.sigma.assign(spectrum.value.size(), 1000.0);
    return fit_spectrum(configuration, spectrum, {.cache = no_cache()});
}

/// Bounds lie so many deviations away that no interval heeds them.
const char* const three_kinds = R"({"free": ["bilirubin_g_per_l", "oxygen_saturation", "offset"], "priors": {
    "bilirubin_g_per_l": {"kind": "log_normal", "median": 0.05, "sigma_log": 0.8},
    "oxygen_saturation": {"kind": "beta", "a": 6, "b": 2},
    "offset": {"kind": "normal", "mean": 0.001, "sigma": 0.002}}})";

TEST(PriorDecides, ValueIsTheMedianAndEveryIntervalThatOfThePrior) {
    for (const char* const kind : {"covariance", "profile", "posterior"}) {
        SCOPED_TRACE(kind);
        const FitResult result = uninformed(three_kinds, kind);
        ASSERT_EQ(result.free.size(), 3U);
        for (const FittedParameter& free : result.free) {
            SCOPED_TRACE(free.name);
            // Of the noise something is left: a hundredth of a prior's deviation.
            EXPECT_NEAR(natural_coordinate(free.prior, free.value), 0.0, 0.01);
            // Tail quantiles of 1000 effective draws scatter by 0.085 deviations.
            const double tolerance = result.posterior ? 5 * 0.085 : 0.02;
            EXPECT_NEAR(natural_coordinate(free.prior, free.uncertainty.interval_95.lower), -normal_95, tolerance);
            EXPECT_NEAR(natural_coordinate(free.prior, free.uncertainty.interval_95.upper), normal_95, tolerance);
            EXPECT_TRUE(free.uncertainty.decided_by_prior);
            EXPECT_EQ(free.uncertainty.status, Status::free);
            EXPECT_GT(free.uncertainty.interval_95.lower, free.bounds.lower);
            EXPECT_LT(free.uncertainty.interval_95.upper, free.bounds.upper);
        }
    }
}

/// The prior on a quantity computed from a parameter is a distribution of that quantity, whatever it is computed from.
TEST(PriorDecides, ADerivedQuantityHasItsPriorsMedianInFitAndPosterior) {
    const char* const ratio = R"({"free": ["pheomelanin_g_per_l"], "priors": {
        "pheomelanin_eumelanin_ratio": {"kind": "log_normal", "median": 0.133, "sigma_log": 0.2}}})";
    const double eumelanin = quick_configuration().values.skin.eumelanin_g_per_l;
    const FitResult fitted = uninformed(ratio, "profile");
    EXPECT_NEAR(std::log(fitted.free[0].value / eumelanin / 0.133) / 0.2, 0.0, 0.02);
    EXPECT_NEAR(std::log(fitted.free[0].uncertainty.interval_95.upper / eumelanin / 0.133) / 0.2, normal_95, 0.05);
    const FitResult sampled = uninformed(ratio, "posterior");
    // The median of 1000 effective draws scatters by 0.04 deviations, the ends by 0.085.
    EXPECT_NEAR(std::log(sampled.posterior->marginals[0].median / eumelanin / 0.133) / 0.2, 0.0, 5 * 0.04);
    EXPECT_NEAR(std::log(sampled.posterior->marginals[0].upper / eumelanin / 0.133) / 0.2, normal_95, 5 * 0.085);
}

TEST(PriorDecides, IsSaidInEveryReport) {
    const FitResult result = uninformed(three_kinds, "covariance");
    EXPECT_NE(text_report(result).find("DECIDED BY THEIR PRIORS: oxygen_saturation, bilirubin_g_per_l, offset"),
              std::string::npos)
        << text_report(result);
    for (const FittedParameter& free : result.free) EXPECT_EQ(parameter_words(free).remark, "DECIDED BY ITS PRIOR");
    EXPECT_EQ(json_report(result)["parameters"]["bilirubin_g_per_l"]["decided_by_prior"], true);
    EXPECT_EQ(json_report(result)["parameters"]["melanosome_fraction"]["decided_by_prior"], false);
}

/// As bilirubin of deep jaundice: beside a prior of 0.05 g/L the sigma is large, and small beside the value.
TEST(PriorDecides, NotWhereALargeValueIsWellKnown) {
    Configuration truth = inner_truth(0.001);
    truth.values.skin.bilirubin_g_per_l = 2.0;
    const Configuration configuration = configured_by_text(truth, R"({"priors": "physiological"})", "test.json");
    for (const UncertaintyMethod method : {UncertaintyMethod::covariance, UncertaintyMethod::profile}) {
        Configuration asked = configuration;
        asked.uncertainty = method;
        const FitResult result =
            fit_spectrum(asked, modelled_spectrum(truth, grid_nm(400, 700, 10)), {.cache = no_cache()});
        for (const FittedParameter& free : result.free) {
            EXPECT_EQ(free.uncertainty.status, Status::free) << free.name;
            EXPECT_FALSE(free.uncertainty.decided_by_prior) << free.name;
            const double truth_value = value_of(truth.values, free.parameter);
            EXPECT_LE(free.uncertainty.interval_95.lower, truth_value) << free.name;
            EXPECT_GE(free.uncertainty.interval_95.upper, truth_value) << free.name;
        }
        EXPECT_EQ(prior_words(result), "");
    }
}

}  // namespace
}  // namespace skinfit::test
