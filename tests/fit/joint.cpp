#include <gtest/gtest.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "fit/models.hpp"
#include "fit/report.hpp"
#include "fit/slow_residuals.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit::test {
namespace {

/// A thin sample, two layers on air, which lets light through.
Configuration thin_sample(Quantity quantity) {
    Configuration configuration = quick_configuration();
    configuration.layers = 2;
    configuration.noise = 0.001;
    configuration.quantity = quantity;
    return configuration;
}

/// What is left open is as each spectrum says.
Configuration open_quantity(Configuration configuration) {
    configuration.quantity.reset();
    return configuration;
}

constexpr std::array of_epidermis = {Parameter::melanosome_fraction, Parameter::epidermis_carotene_g_per_l};

Configuration with_epidermis_free() {
    return with_free(open_quantity(thin_sample(Quantity::reflectance)), {of_epidermis.begin(), of_epidermis.end()});
}

std::vector<Spectrum> both_sides() {
    const std::vector<double> wavelengths_nm = grid_nm(420, 680, 20);
    std::vector<Spectrum> spectra;
    for (const Quantity quantity : {Quantity::reflectance, Quantity::transmittance}) {
        Configuration truth = thin_sample(quantity);
        truth.values.skin.melanosome_fraction = 0.03;
        truth.values.skin.epidermis_carotene_g_per_l = 0.005;
        spectra.push_back(modelled_spectrum(truth, wavelengths_nm));
    }
    return spectra;
}

/// Two sites that differ in the blood of the papillary dermis.
std::vector<Spectrum> two_sites() {
    std::vector<Spectrum> spectra;
    for (const double blood : {0.01, 0.04}) {
        Configuration truth = quick_configuration();
        truth.values.skin.melanosome_fraction = 0.03;
        truth.values.skin.papillary_blood_fraction = blood;
        spectra.push_back(modelled_spectrum(truth, grid_nm(400, 700, 10)));
    }
    return spectra;
}

Configuration site_configuration() {
    return with_own(with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::oxygen_saturation}),
                    "papillary_blood_fraction", "test");
}

Objective objective_of(const FitProblem& problem) {
    return {problem, make_models(problem, Engine::paths, no_cache())};
}

TEST(JointFit, MisfitsOfTheSpectraStandBelowEachOther) {
    const std::vector<Spectrum> spectra = both_sides();
    const FitProblem joint = make_problem(with_epidermis_free(), spectra);
    const std::vector<double> values = {0.05, 0.001};
    const Misfit whole = objective_of(joint).misfit(values);
    ASSERT_EQ(whole.residual.size(), 28);
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        const FitProblem alone = make_problem(with_epidermis_free(), spectra[k]);
        const Misfit part = objective_of(alone).misfit(values);
        const auto first = static_cast<Eigen::Index>(14 * k);
        EXPECT_EQ(whole.residual.segment(first, 14), part.residual);
        EXPECT_EQ(whole.jacobian.middleRows(first, 14), part.jacobian);
    }
}

TEST(JointFit, ReflectanceAndTransmittanceTogetherRecoverTheTruthMoreSurelyThanEither) {
    const std::vector<Spectrum> spectra = both_sides();
    const FitOptions options{.cache = no_cache()};
    const FitResult joint = fit_spectra(with_epidermis_free(), spectra, options);
    const std::array truth = {0.03, 0.005};
    ASSERT_EQ(joint.free.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double sigma = joint.free[i].uncertainty.sigma.value();
        // The spectra are those of the fit's own rays: only the solver's tolerance is left.
        EXPECT_NEAR(joint.free[i].value, truth[i], 1e-3 * sigma) << joint.free[i].name;
        for (const Spectrum& spectrum : spectra) {
            EXPECT_LT(sigma, fit_spectrum(with_epidermis_free(), spectrum, options).free[i].uncertainty.sigma.value());
        }
    }
}

/// An orthonormal basis of what the free parameters change at the answer: the data's rows.
Eigen::MatrixXd fitted_directions(const FitResult& result, const FitProblem& problem) {
    std::vector<double> values;
    for (const FittedParameter& free : result.free) values.push_back(free.value);
    const Objective objective = objective_of(problem);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(objective.misfit(values).jacobian);
    return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), qr.cols());
}

TEST(JointFit, ItsMisfitIsThatOfAllReadingsAndItsSlowResidualsThoseOfTheWorstSpectrum) {
    std::vector<Spectrum> spectra = two_sites();
    const std::vector<double> normal = normal_numbers(3, spectra[0].value.size());
    for (Spectrum& spectrum : spectra) {
        for (std::size_t i = 0; i < normal.size(); ++i) spectrum.value[i] += 0.006 * normal[i];
    }
    for (std::size_t i = 0; i < normal.size(); ++i)
        spectra[1].value[i] += 0.01 * std::sin(0.7 * static_cast<double>(i));
    spectra[1].wavelength_nm.resize(21);
    spectra[1].value.resize(21);
    const FitResult joint = fit_spectra(site_configuration(), spectra, {.cache = no_cache()});
    double squares = 0.0;
    double chi2 = 0.0;
    std::vector<double> p_values;
    const Eigen::MatrixXd fitted = fitted_directions(joint, make_problem(site_configuration(), spectra));
    Eigen::Index first = 0;
    for (const FittedSpectrum& spectrum : joint.spectra) {
        std::vector<double> residuals;
        for (std::size_t i = 0; i < spectrum.measured.size(); ++i) {
            const double difference = spectrum.modelled[i] - spectrum.measured[i];
            squares += difference * difference;
            residuals.push_back(difference / spectrum.sigma[i]);
            chi2 += residuals.back() * residuals.back();
        }
        const auto count = static_cast<Eigen::Index>(residuals.size());
        p_values.push_back(slow_residuals_p_value(Eigen::Map<const Eigen::VectorXd>(residuals.data(), count),
                                                  fitted.middleRows(first, count))
                               .value());
        first += count;
    }
    constexpr double readings = 31 + 21;
    constexpr double rounding = 1e-12;
    EXPECT_EQ(joint.degrees_of_freedom, readings - 4);
    EXPECT_NEAR(joint.rmse / std::sqrt(squares / readings), 1.0, rounding);
    EXPECT_NEAR(joint.chi2 / chi2, 1.0, rounding);
    EXPECT_NEAR(joint.inflation.value() / std::sqrt(chi2 / (readings - 4)), 1.0, rounding);
    EXPECT_NEAR(joint.p_value.value(), chi_square_p_value(chi2, readings - 4), rounding);
    EXPECT_NEAR(joint.unexplained_rmse / joint.rmse, 1.0, rounding);
    EXPECT_NEAR(joint.departure_rms, 0.0, rounding);
    // By Bonferroni: one of two spectra is this improbable by chance twice as often as one alone.
    const double least = std::ranges::min(p_values);
    ASSERT_LT(least, 0.5);
    EXPECT_NEAR(joint.slow_residuals_p_value.value() / (2.0 * least), 1.0, 1e-9);
}

TEST(JointFit, AnOwnParameterTouchesItsSpectrumAlone) {
    const std::vector<Spectrum> spectra = two_sites();
    const FitProblem problem = make_problem(site_configuration(), spectra);
    std::vector<std::string> names;
    for (const FreeParameter& free : problem.free) names.push_back(name_of(free));
    EXPECT_EQ(names, (std::vector<std::string>{"melanosome_fraction", "papillary_blood_fraction[1]",
                                               "papillary_blood_fraction[2]", "oxygen_saturation"}));
    const Eigen::MatrixXd jacobian = objective_of(problem).misfit(starts(problem)).jacobian;
    EXPECT_TRUE(jacobian.col(1).tail(31).isZero(0.0));
    EXPECT_TRUE(jacobian.col(2).head(31).isZero(0.0));
    EXPECT_GT(jacobian.col(1).head(31).norm(), 0.0);
    // The sites start alike: what one does to its spectrum, the other does to its own.
    EXPECT_EQ(jacobian.col(1).head(31), jacobian.col(2).tail(31));
}

TEST(JointFit, SitesShareWhatIsNotTheirOwn) {
    const FitResult result = fit_spectra(site_configuration(), two_sites(), {.cache = no_cache()});
    const std::array truth = {0.03, 0.01, 0.04, quick_configuration().values.skin.oxygen_saturation};
    ASSERT_EQ(result.free.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(result.free[i].value, truth[i], 1e-3 * result.free[i].uncertainty.sigma.value())
            << result.free[i].name;
    }
    const Json json = json_report(result);
    EXPECT_EQ(json["spectra"].size(), 2U);
    EXPECT_TRUE(json["parameters"].contains("papillary_blood_fraction[2]"));
    EXPECT_EQ(json["parameters"].size(), parameter_count + 1);
    const std::string text = text_report(result);
    EXPECT_NE(text.find("2 spectra, explained together\n  [1] "), std::string::npos);
    EXPECT_NE(text.find("papillary_blood_fraction[2] "), std::string::npos);
    // The same fit runs again from its report.
    const Configuration again = configured(default_configuration(), json, "result.json");
    EXPECT_EQ(json_report(fit_spectra(again, two_sites(), {.cache = no_cache()}))["parameters"], json["parameters"]);
}

TEST(JointFit, OneSpectrumHasNoUseForOwnParameters) {
    const std::vector<Spectrum> one = {two_sites().front()};
    const FitProblem problem = make_problem(site_configuration(), one);
    EXPECT_EQ(name_of(problem.free[1]), "papillary_blood_fraction");
}

TEST(JointFit, APriorOnWhatSitesHaveOfTheirOwnHoldsForEach) {
    Configuration configuration = site_configuration();
    configuration.derived_priors[static_cast<std::size_t>(Derived::total_blood_fraction)] =
        NormalPrior{.mean = 0.02, .sigma = 0.01};
    const FitProblem problem = make_problem(configuration, two_sites());
    ASSERT_EQ(problem.derived_priors.size(), 2U);
    const Misfit misfit = objective_of(problem).misfit(starts(problem));
    ASSERT_EQ(misfit.residual.size(), 62 + 2);
    const Eigen::RowVectorXd first = misfit.jacobian.row(62);
    const Eigen::RowVectorXd second = misfit.jacobian.row(63);
    EXPECT_GT(first[1], 0.0);
    EXPECT_EQ(first[2], 0.0);
    EXPECT_EQ(second[1], 0.0);
    EXPECT_EQ(second[2], first[1]);
}

std::string refusal(const Configuration& configuration, const std::vector<Spectrum>& spectra) {
    return refusal_of([&] { (void)make_problem(configuration, spectra); });
}

TEST(JointFit, MoreLightThanThereIsIsRefusedBeyondTheNoise) {
    std::vector<Spectrum> spectra = both_sides();
    EXPECT_EQ(refusal(with_epidermis_free(), spectra), "");
    const double sigma = std::hypot(0.001, 0.001);
    spectra[1].value[3] = 1.0 - spectra[0].value[3] + 2.9 * sigma;
    EXPECT_EQ(refusal(with_epidermis_free(), spectra), "");
    spectra[1].value[3] += 0.2 * sigma;
    const std::string message = refusal(with_epidermis_free(), spectra);
    EXPECT_NE(message.find("at 480 nm add up to 1.004"), std::string::npos) << message;
}

TEST(JointFit, TheSameValuesTwiceAreRefused) {
    std::vector<Spectrum> spectra = two_sites();
    spectra[1].value = spectra[0].value;
    EXPECT_NE(refusal(site_configuration(), spectra).find("spectra 1 and 2 hold the same values"), std::string::npos);
}

TEST(JointFit, OnlyWhatIsFreeCanBeOwn) {
    Configuration configuration = site_configuration();
    configuration.free[static_cast<std::size_t>(Parameter::papillary_blood_fraction)] = false;
    EXPECT_NE(refusal(configuration, two_sites()).find("own: papillary_blood_fraction: is not free"),
              std::string::npos);
}

}  // namespace
}  // namespace skinfit::test
