#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fit/problem.hpp"
#include "report/fitted_experiment.hpp"
#include "report/interval_picture.hpp"
#include "report/light_budget.hpp"
#include "report/posterior_picture.hpp"
#include "report/profile_picture.hpp"
#include "report/spectrum_colour.hpp"
#include "tests/fit/example_result.hpp"

namespace skinfit {
namespace {

double sum(const LightShares& shares) {
    return std::accumulate(shares.absorbed.begin(), shares.absorbed.end(),
                           shares.surface + shares.reflected + shares.transmitted);
}

constexpr double rounding = 1e-10;  // of some thousand sums of numbers below 1

std::vector<Experiment> specimens() {
    Experiment whole;
    Experiment thin = whole;
    thin.layers = 2;
    thin.base = {.kind = Base::Kind::index, .refractive_index = 1.0};
    Experiment ear = whole;
    ear.base.kind = Base::Kind::matched;
    ear.incidence_rad = 0.8;
    return {whole, thin, ear};
}

TEST(LightBudget, AddsUpToOne) {
    for (const Experiment& experiment : specimens()) {
        for (const LightShares& shares : light_budget(experiment, {400, 550, 700})) {
            EXPECT_NEAR(sum(shares), 1.0, rounding) << shares.wavelength_nm;
            // A share that is forgotten is missed.
            EXPECT_GT(std::abs(sum(shares) - shares.absorbed[0] - 1.0), rounding) << shares.wavelength_nm;
        }
    }
}

TEST(LightBudget, IsWhatTheSpectrophotometerReads) {
    const std::vector<double> nm = {420, 560, 680};
    for (const Experiment& experiment : specimens()) {
        const std::vector<LightShares> budget = light_budget(experiment, nm);
        const std::vector<Reading> readings = read_by_solver(experiment, nm);
        for (std::size_t i = 0; i < nm.size(); ++i) {
            EXPECT_EQ(budget[i].surface + budget[i].reflected, readings[i].reflectance);
            EXPECT_EQ(budget[i].transmitted, readings[i].transmittance);
        }
    }
}

TEST(LightBudget, FollowsTheWavelengthShift) {
    Experiment shifted;
    shifted.values.instrument.wavelength_shift_nm = 10;
    EXPECT_EQ(light_budget(shifted, {550}).front().absorbed, light_budget(Experiment{}, {560}).front().absorbed);
}

TEST(LightBudget, MoreBloodTakesLightFromEveryLayerAndFromWhatLeaves) {
    Experiment pale;
    Experiment red = pale;
    red.values.skin.papillary_blood_fraction *= 3;
    const LightShares before = light_budget(pale, {540}).front();
    const LightShares after = light_budget(red, {540}).front();
    EXPECT_GT(after.absorbed[2], before.absorbed[2]);
    EXPECT_LT(after.absorbed[3], before.absorbed[3]);
    EXPECT_LT(after.reflected, before.reflected);
    EXPECT_EQ(after.surface, before.surface);
}

TEST(LightBudget, SpreadsFewWavelengthsOverMany) {
    std::vector<double> nm(301);
    std::iota(nm.begin(), nm.end(), 400.0);
    const std::vector<LightShares> budget = light_budget(Experiment{}, nm);
    EXPECT_EQ(budget.size(), 61U);
    EXPECT_EQ(budget.front().wavelength_nm, 400);
    EXPECT_EQ(budget.back().wavelength_nm, 700);
}

TEST(LightFates, LeaveOutWhatNeverHappens) {
    const std::vector<LightFate> opaque = light_fates(light_budget(specimens()[0], {550}));
    EXPECT_EQ(opaque.size(), 6U);  // nothing passes the hypodermis
    const std::vector<LightFate> thin = light_fates(light_budget(specimens()[1], {550}));
    EXPECT_EQ(thin.size(), 5U);  // two layers absorb
}

TEST(FittedExperiment, HasTheFittedValuesAndTheFixedOnes) {
    const FitResult result = test::example_result();
    const Skin skin = fitted_experiment(result, 0).values.skin;
    EXPECT_EQ(skin.melanosome_fraction, 0.0234567);
    EXPECT_EQ(skin.bilirubin_g_per_l, 0.0);
    EXPECT_EQ(skin.hemoglobin_g_per_l, Skin{}.hemoglobin_g_per_l);
    EXPECT_NEAR(fitted_experiment(result, 0).incidence_rad, std::acos(-1.0) / 4, 1e-15);
}

TEST(FittedExperiment, GivesAParameterOfItsOwnToItsSpectrumAlone) {
    FitResult result = test::good_result();
    result.spectra.push_back(result.spectra.front());
    for (std::size_t k = 0; k < 2; ++k) {
        FittedParameter own = result.free.front();
        own.parameter = Parameter::oxygen_saturation;
        own.value = k == 0 ? 0.2 : 0.9;
        own.name = name_of(
            FreeParameter{.parameter = own.parameter, .start = own.start, .bounds = own.bounds, .measurement = k});
        result.free.push_back(own);
    }
    EXPECT_EQ(fitted_experiment(result, 0).values.skin.oxygen_saturation, 0.2);
    EXPECT_EQ(fitted_experiment(result, 1).values.skin.oxygen_saturation, 0.9);
    EXPECT_EQ(fitted_experiment(result, 1).values.skin.melanosome_fraction, 0.0234567);
}

TEST(ProfilePicture, NamesEveryParameterAndEveryLine) {
    FitResult result = test::profiled_result();
    const std::string picture = profile_picture(result);
    for (const FittedParameter& free : result.free) EXPECT_NE(picture.find(free.name), std::string::npos) << free.name;
    for (const char* words : {"profile", "95 % threshold", "95 % interval", "covariance", "out of bounds"}) {
        EXPECT_NE(picture.find(words), std::string::npos) << words;
    }
    // Every curve tells: another one is another picture.
    result.profile->intervals.back().curve.back().cost_rise += 1.0;
    EXPECT_NE(profile_picture(result), picture);
}

TEST(Histogram, CountsEveryValueOnce) {
    const Histogram found = histogram({0.0, 0.1, 0.2, 0.9, 1.0}, 4);
    EXPECT_EQ(found.share, (std::vector<double>{3 * 0.2, 0.0, 0.0, 2 * 0.2}));
    EXPECT_EQ(found.centre, (std::vector<double>{0.125, 0.375, 0.625, 0.875}));
}

TEST(Colour, OfEqualSpectraDoesNotDiffer) {
    FittedSpectrum spectrum = test::good_result().spectra.front();
    EXPECT_GT(fitted_colour(spectrum).ciede2000, 0.0);
    spectrum.modelled = spectrum.measured;
    EXPECT_EQ(fitted_colour(spectrum).ciede2000, 0.0);
}

TEST(Colour, OfAGreyIsItsLightness) {
    FittedSpectrum spectrum = test::good_result().spectra.front();
    spectrum.modelled = {0.25, 0.25, 0.25};
    const SpectrumColour grey = fitted_colour(spectrum).modelled;
    EXPECT_NEAR(grey.lab.l, 116.0 * std::cbrt(0.25) - 16.0, 1e-9);  // CIE 1976, Y = 25
    EXPECT_NEAR(grey.lab.a, 0.0, 1e-9);
    EXPECT_NEAR(grey.lab.b, 0.0, 1e-9);
}

TEST(HealthyRanges, HoldThePriorsOfTheirParameters) {
    for (const PhysiologicalPrior& each : physiological_priors()) {
        if (!each.healthy) continue;
        EXPECT_LT(each.healthy->lower, each.healthy->upper);
        // The prior is centred on the published range, on its own scale.
        if (const auto* const prior = std::get_if<LogNormalPrior>(&each.prior)) {
            const double centre = std::sqrt(each.healthy->lower * each.healthy->upper);
            const double width = std::log(each.healthy->upper / each.healthy->lower) / 2;
            EXPECT_NEAR(prior->median / centre, 1.0, 0.005) << info(each.parameter).name;  // stated to three digits
            EXPECT_NEAR(prior->sigma_log / width, 1.0, 0.005) << info(each.parameter).name;
        }
    }
}

}  // namespace
}  // namespace skinfit
