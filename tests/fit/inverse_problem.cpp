#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "model/chromophores.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit::test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The quick configuration changed by JSON.
Configuration stated(const std::string& text) {
    return configured_by_text(quick_configuration(), text, "c.json");
}

Spectrum spectrum_of_table_1() {
    return modelled_spectrum(quick_configuration(), grid_nm(400, 700, 10));
}

const std::string everything = R"({
    "priors": {"melanosome_fraction": {"kind": "log_normal", "median": 0.07, "sigma_log": 1.5},
               "oxygen_saturation": {"kind": "beta", "a": 2, "b": 3},
               "hemoglobin_g_per_l": {"kind": "normal", "mean": 150, "sigma": 10},
               "total_blood_fraction": {"kind": "normal", "mean": 0.02, "sigma": 0.01},
               "pheomelanin_eumelanin_ratio": {"kind": "log_normal", "median": 0.13, "sigma_log": 1}},
    "exclude_nm": [[500, 520]], "weights": [[600, 650, 0.25]], "loss": "cauchy",
    "discrepancy": {"sigma": 0.005, "length_nm": 30, "kernel": "matern_3_2"},
    "free": ["melanosome_fraction", "eumelanin_g_per_l", "papillary_blood_fraction", "reticular_blood_fraction",
             "oxygen_saturation", "hemoglobin_g_per_l", "scale"]})";

/// A spectrum that the starts do not explain.
Spectrum brighter(Spectrum spectrum) {
    for (double& value : spectrum.value) value = 1.1 * value + 0.01;
    return spectrum;
}

TEST(InverseProblem, MisfitHasTheDerivativesOfItsResidualsWhateverIsStated) {
    const Configuration configuration = stated(everything);
    const Task task(configuration, brighter(spectrum_of_table_1()));
    const std::vector<double> values = {0.03, 100.0, 0.03, 0.01, 0.6, 140.0, 1.1};
    const Misfit misfit = task.objective.misfit(values);
    ASSERT_EQ(misfit.residual.size(), 28 + 5);
    for (std::size_t i = 0; i < values.size(); ++i) {
        SCOPED_TRACE(info(task.problem.free[i].parameter).name);
        const auto residual = [&](const std::vector<double>& point) { return task.objective.misfit(point).residual; };
        const auto central = [&](double h) { return central_difference(residual, values, i, h); };
        const double h = 1e-2 * values[i];
        const Eigen::VectorXd coarse = (4.0 * central(h / 2) - central(h)) / 3.0;
        const Eigen::VectorXd fine = (16.0 * (4.0 * central(h / 4) - central(h / 2)) / 3.0 - coarse) / 15.0;
        // The last extrapolation changes more than what is left; rounding of residuals of some tens of sigmas,
        // whitened.
        const double error = (fine - coarse).cwiseAbs().maxCoeff() + 1e4 * epsilon / (h / 4);
        const Eigen::VectorXd exact = misfit.jacobian.col(static_cast<Eigen::Index>(i));
        EXPECT_LE((fine - exact).cwiseAbs().maxCoeff(), error);
        EXPECT_LT(error, 1e-4 * exact.cwiseAbs().maxCoeff()) << "the differences are too coarse to judge";
    }
}

TEST(InverseProblem, Chi2KnowsNothingOfWeightsLossAndPriors) {
    const Spectrum spectrum = brighter(spectrum_of_table_1());
    const std::vector<double> values = {0.03, 0.02, 0.01, 0.5, 0.1};
    const Task plain(stated("{}"), spectrum);
    const Task stated_task(stated(R"({"loss": "huber", "weights": [[400, 700, 4]], "priors": "physiological"})"),
                           spectrum);
    EXPECT_EQ(stated_task.objective.chi2(values), plain.objective.chi2(values));
    EXPECT_EQ(plain.objective.misfit(values).cost(), plain.objective.chi2(values));
    EXPECT_NE(stated_task.objective.misfit(values).cost(), plain.objective.chi2(values));
}

TEST(InverseProblem, AWeightOfFourCountsLikeHalfTheNoise) {
    const Spectrum spectrum = brighter(spectrum_of_table_1());
    const std::vector<double> values = {0.03, 0.02, 0.01, 0.5, 0.1};
    const Task weighted(stated(R"({"weights": [[0, 1000, 4]]})"), spectrum);
    const Task quiet(stated(R"({"noise": 0.003})"), spectrum);
    const double wanted = quiet.objective.misfit(values).cost();
    EXPECT_NEAR(weighted.objective.misfit(values).cost(), wanted, 100 * epsilon * wanted);
}

TEST(InverseProblem, ExcludedWavelengthsDoNotMatter) {
    Spectrum spectrum = spectrum_of_table_1();
    const Configuration masked = stated(R"({"exclude_nm": [[495, 505], [600, 620]]})");
    const FitProblem problem = make_problem(resolved(masked, spectrum), spectrum);
    EXPECT_EQ(problem.only().wavelength_nm.size(), 31U - 4U);
    spectrum.value[10] = 1.0;  // 500 nm
    EXPECT_EQ(make_problem(resolved(masked, spectrum), spectrum).only().measured, problem.only().measured);
}

TEST(InverseProblem, APriorActsLikeAMeasurementOfTheParameter) {
    // Without curvature the mean of two measurements is weighted by their inverse variances: offset and scale are
    // linear.
    Configuration configuration = stated(R"({"free": ["offset"],
        "priors": {"offset": {"kind": "normal", "mean": 0.05, "sigma": 0.001}}})");
    const Task task(configuration, spectrum_of_table_1());
    const double by_data = 31 / (0.006 * 0.006);
    const double by_prior = 1 / (0.001 * 0.001);
    const Minimum found = minimise_by_ceres(task.objective, starts(task.problem));
    EXPECT_NEAR(found.values[0], 0.05 * by_prior / (by_prior + by_data), 1e-9);
}

TEST(InverseProblem, AnOutlierPullsAnOffsetAsTheLossSays) {
    constexpr double sigma = 0.006;
    Spectrum spectrum = spectrum_of_table_1();
    spectrum.value[14] += 0.3;  // 50 sigmas, one of 31 values
    const auto pull = [&](const std::string& loss) {
        const Task task(stated(R"({"free": ["offset"], "loss": ")" + loss + R"("})"), spectrum);
        return minimise_by_ceres(task.objective, starts(task.problem)).values[0];
    };
    // Ceres' steps end at 1e-9 of the box, 0.2 wide.
    constexpr double error = 1e-9;
    EXPECT_NEAR(pull("squares"), 0.3 / 31, error);
    // Thirty small residuals balance one of constant pull.
    EXPECT_NEAR(pull("huber"), 1.345 * sigma / 30, error);
    const auto cauchy_pull = [](double r) { return r / (1 + r * r / (2.385 * 2.385)); };
    const double offset = pull("cauchy");
    // Ceres stops where the cost of about 35 changes by 1e-10 of itself: an offset of 1e-5 sigma, times 30 values.
    EXPECT_NEAR(30 * cauchy_pull(offset / sigma), cauchy_pull((0.3 - offset) / sigma), 3e-4);
}

TEST(InverseProblem, DegreesOfFreedomCountWhatTheDataDetermine) {
    const FitResult without = fit_spectrum(stated("{}"), spectrum_of_table_1(), {.cache = no_cache()});
    EXPECT_EQ(without.degrees_of_freedom, 26.0);
    // A prior far narrower than the data takes its parameter away from them; a far wider one does nothing.
    const auto with_sigma = [](const std::string& sigma) {
        const std::string text = R"({"free": ["melanosome_fraction", "scale"],
            "priors": {"scale": {"kind": "normal", "mean": 1, "sigma": )" +
                                 sigma + "}}}";
        return fit_spectrum(stated(text), spectrum_of_table_1(), {.cache = no_cache()}).degrees_of_freedom;
    };
    EXPECT_NEAR(with_sigma("1e-6"), 30.0, 1e-3);
    EXPECT_NEAR(with_sigma("2"), 29.0, 1e-3);
}

/// The message with which a problem is refused; empty where it is not.
std::string refusal(const std::string& text, const Spectrum& spectrum) {
    return refusal_of([&] { (void)make_problem(resolved(stated(text), spectrum), spectrum); });
}

TEST(InverseProblem, ContradictionsAreRefused) {
    const Spectrum spectrum = spectrum_of_table_1();
    for (const auto& [text, words] : {
             std::pair{R"({"priors": {"oxygen_saturation": {"kind": "normal", "mean": 2, "sigma": 1}}})", "outside"},
             std::pair{R"({"priors": {"oxygen_saturation": {"kind": "normal", "mean": 0.5, "sigma": 10}}})",
                       "of its mass"},
             std::pair{R"({"exclude_nm": [[0, 1000]]})", "leaves no wavelength"},
             std::pair{R"({"wavelength_min_nm": 551, "wavelength_max_nm": 553})", "the file has none between them"},
             std::pair{R"({"free": []})", "no parameter is free"},
         }) {
        EXPECT_NE(refusal(text, spectrum).find(words), std::string::npos) << text << ": " << refusal(text, spectrum);
    }
    Spectrum constant = spectrum;
    std::ranges::fill(constant.value, 0.4);
    EXPECT_NE(refusal("{}", constant).find("all 31 values"), std::string::npos);
}

TEST(InverseProblem, TheStartIsReportedAsItWasWhereAPriorExcludesTheConfiguredOne) {
    const Configuration at_zero = stated(R"({"priors": "physiological", "parameters": {"bilirubin_g_per_l": 0}})");
    for (const FittedParameter& fitted : fit_spectrum(at_zero, spectrum_of_table_1(), {.cache = no_cache()}).free) {
        EXPECT_GE(fitted.start, fitted.bounds.lower) << fitted.name;
        EXPECT_LE(fitted.start, fitted.bounds.upper) << fitted.name;
    }
}

TEST(InverseProblem, AShiftMayReachTheEndOfTheTablesAndNoFurther) {
    const double lowest_nm = modelled_wavelengths().lowest_nm;
    const auto refusal_from = [](double first_nm) {
        Spectrum spectrum;
        spectrum.wavelength_nm = {first_nm, 400, 500, 600};
        spectrum.value = {0.1, 0.2, 0.3, 0.4};
        return refusal(R"({"engine": "solver", "free": ["wavelength_shift_nm"], "wavelength_min_nm": 250})", spectrum);
    };
    EXPECT_EQ(refusal_from(lowest_nm + 5), "");  // as far as the bounds of the shift reach
    EXPECT_NE(refusal_from(lowest_nm + 4.9).find("may lead to"), std::string::npos);
}

TEST(InverseProblem, FewerWavelengthsThanParametersNeedPriorsAndAreNamed) {
    const Spectrum spectrum = modelled_spectrum(quick_configuration(), {450, 550, 650});
    EXPECT_NE(refusal("{}", spectrum).find("3 wavelengths"), std::string::npos);
    const FitResult result = fit_spectrum(stated(R"({"priors": "physiological"})"), spectrum, {.cache = no_cache()});
    EXPECT_EQ(result.verdict, Verdict::suspect);
    ASSERT_FALSE(result.reasons.empty());
    EXPECT_TRUE(result.reasons[0].starts_with("FEWER WAVELENGTHS THAN PARAMETERS")) << result.reasons[0];
}

TEST(InverseProblem, PhysiologicalPriorsFitTheDefaultBounds) {
    std::string free;
    for (const ParameterInfo& row : parameter_table()) {
        if (row.parameter == Parameter::fold_aspect_ratio || row.parameter == Parameter::specular_fraction) continue;
        free += (free.empty() ? "\"" : ", \"") + std::string(row.name) + "\"";
    }
    EXPECT_EQ(
        refusal(R"({"engine": "solver", "priors": "physiological", "free": [)" + free + "]}", spectrum_of_table_1()),
        "");
}

}  // namespace
}  // namespace skinfit::test
