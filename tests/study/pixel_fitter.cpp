#include "study/pixel_fitter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/input_error.hpp"
#include "fit/fit.hpp"
#include "fit/models.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/study/synthetic_cube.hpp"

namespace skinfit::test {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// A small cube without files.
struct Pixels {
    SyntheticCube cube = synthetic_cube(5, 4, 0.001, 1);
    Spectrum common;

    Pixels() {
        common.name = common.source = "synthetic";
        common.wavelength_nm = cube.wavelength_nm;
    }
    [[nodiscard]] std::size_t count() const { return cube.truth.size(); }
    [[nodiscard]] std::vector<double> values(std::size_t pixel) const {
        const auto bands = static_cast<std::ptrdiff_t>(cube.wavelength_nm.size());
        const auto first = cube.fractions.begin() + static_cast<std::ptrdiff_t>(pixel) * bands;
        return {first, first + bands};
    }
    [[nodiscard]] PixelFitter fitter() const { return {cube.configuration, common, no_cache()}; }
};

TEST(PixelFitter, EqualsTheFitInBulkToTheBit) {
    const Pixels pixels;
    const PixelFitter fitter = pixels.fitter();
    const FitProblem& problem = fitter.problem();
    const std::vector<ForwardModel> models = make_models(problem, Engine::emulator, no_cache());
    const auto bands = static_cast<Eigen::Index>(pixels.cube.wavelength_nm.size());
    const Eigen::Map<const Eigen::MatrixXd> spectra(pixels.cube.fractions.data(), bands,
                                                    static_cast<Eigen::Index>(pixels.count()));
    const std::vector<BulkFit> fits = fit_in_bulk(problem, std::get<Emulator>(models.front()), spectra, pixel_options);
    for (std::size_t i = 0; i < fits.size(); ++i) {
        const PixelFit fit = fitter.fit(pixels.values(i));
        EXPECT_EQ(fit.status, FitStatus::fitted) << name_of(fit.reason);
        EXPECT_EQ(fit.values, fits[i].values);
        EXPECT_EQ(fit.chi2, fits[i].chi2);
        EXPECT_EQ(fit.rmse, fits[i].rmse);
        for (std::size_t j = 0; j < fit.sigmas.size(); ++j) {
            const auto column = static_cast<Eigen::Index>(j);
            EXPECT_EQ(fit.sigmas[j], std::sqrt(fits[i].covariance(column, column)));
        }
    }
}

TEST(PixelFitter, EqualsTheSingleFitByTheEmulator) {
    const Pixels pixels;
    const PixelFitter fitter = pixels.fitter();
    for (std::size_t i = 0; i < pixels.count(); i += 3) {
        Spectrum spectrum = pixels.common;
        spectrum.value = pixels.values(i);
        const FitResult single = fit_spectrum(pixels.cube.configuration, spectrum, {.cache = no_cache()});
        const PixelFit fit = fitter.fit(spectrum.value);
        // Both end where a further step would be shorter than 1e-3 sigma, so that chi2 is within 1e-6 of its minimum.
        ASSERT_NEAR(fit.chi2, single.chi2, 1e-5);
        for (std::size_t j = 0; j < fit.values.size(); ++j) {
            const double sigma = single.free[j].uncertainty.sigma.value();
            EXPECT_NEAR(fit.values[j], single.free[j].value, 2e-3 * sigma);
            EXPECT_NEAR(fit.sigmas[j], sigma, 0.01 * sigma);
        }
        EXPECT_NEAR(fit.rmse, single.rmse, 1e-6);
    }
}

TEST(PixelFitter, RejectsWhatTheChecksWarnOfAndFitsNothing) {
    const Pixels pixels;
    const PixelFitter fitter = pixels.fitter();
    const std::vector<double> good = pixels.values(7);
    const std::size_t last = good.size() - 1;
    const double darkest = std::ranges::min(good);
    const auto changed = [&](const std::function<double(std::size_t, double)>& change) {
        std::vector<double> values = good;
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = change(i, values[i]);
        return values;
    };
    const std::vector<std::pair<PixelReason, std::vector<double>>> cases = {
        {PixelReason::missing_values, changed([](std::size_t i, double v) { return i == 3 ? missing : v; })},
        {PixelReason::unit_conflict, changed([](std::size_t, double v) { return 100 * v; })},
        {PixelReason::outside_0_1, changed([](std::size_t i, double v) { return i == 3 ? -0.01 : v; })},
        {PixelReason::offset, changed([&](std::size_t, double v) { return v - darkest + 0.001; })},
        {PixelReason::dark_everywhere, changed([](std::size_t, double v) { return 0.05 + 0.01 * v; })},
        {PixelReason::spikes, changed([](std::size_t i, double v) { return i == 10 ? v + 0.2 : v; })},
        {PixelReason::collapse_at_end, changed([&](std::size_t i, double v) { return i == last ? 0.3 * v : v; })},
        {PixelReason::falling_end, changed([&](std::size_t i, double v) { return i == last ? 0.6 * v : v; })},
        {PixelReason::saturation,
         changed([&](std::size_t i, double v) { return i + 5 > last ? good[last] + 0.05 : v; })},
        {PixelReason::no_hemoglobin,
         changed([](std::size_t i, double) { return 0.2 + 0.01 * static_cast<double>(i); })},
    };
    EXPECT_EQ(fitter.fit(good).reason, PixelReason::none);
    for (const auto& [reason, values] : cases) {
        const PixelFit fit = fitter.fit(values);
        EXPECT_EQ(fit.status, FitStatus::rejected) << name_of(reason);
        EXPECT_EQ(name_of(fit.reason), name_of(reason));
        for (const double number : fit.values) EXPECT_TRUE(std::isnan(number));
        for (const double number : fit.sigmas) EXPECT_TRUE(std::isnan(number));
        EXPECT_TRUE(std::isnan(fit.chi2));
        EXPECT_TRUE(std::isnan(fit.rmse));
    }
}

TEST(PixelFitter, NeedsNoNumbersOutsideTheWindowOfTheFit) {
    Pixels pixels;
    pixels.cube.configuration.wavelength_min_nm = 420;
    const PixelFitter fitter = pixels.fitter();
    std::vector<double> values = pixels.values(7);
    const PixelFit complete = fitter.fit(values);
    values[0] = values[1] = missing;
    const PixelFit fit = fitter.fit(values);
    EXPECT_EQ(fit.status, FitStatus::fitted);
    EXPECT_EQ(fit.values, complete.values);
    values[2] = missing;
    EXPECT_EQ(fitter.fit(values).reason, PixelReason::missing_values);
}

TEST(PixelFitter, DoubtsAMisfit) {
    const Pixels pixels;
    std::vector<double> values = pixels.values(7);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += i % 2 == 0 ? 0.007 : -0.007;
    const PixelFit fit = pixels.fitter().fit(values);
    EXPECT_EQ(fit.status, FitStatus::suspect);
    EXPECT_EQ(fit.reason, PixelReason::misfit);
    EXPECT_FALSE(std::isnan(fit.values[0]));
}

TEST(PixelFitter, DoubtsAParameterAtItsBoundAndGivesItNoSigma) {
    Pixels pixels;
    const auto blood = static_cast<std::size_t>(Parameter::papillary_blood_fraction);
    // The truth lies far above.
    pixels.cube.configuration.bounds[blood].upper = 0.005;
    pixels.cube.configuration.values.skin.papillary_blood_fraction = 0.004;
    pixels.cube.configuration.noise = 0.05;  // so that chi2 is no reason
    const PixelFit fit = pixels.fitter().fit(pixels.values(17));
    EXPECT_EQ(fit.status, FitStatus::suspect);
    EXPECT_EQ(name_of(fit.reason), name_of(PixelReason::at_bound));
    EXPECT_EQ(fit.values[1], 0.005);
    EXPECT_TRUE(std::isnan(fit.sigmas[1]));
}

TEST(PixelFitter, DoubtsWhatCannotBeIdentified) {
    Pixels pixels;
    pixels.cube.configuration = with_free(pixels.cube.configuration, {Parameter::bilirubin_g_per_l});
    // Nothing absorbs bilirubin's light at long wavelengths.
    pixels.cube.configuration.wavelength_min_nm = 600;
    pixels.cube.configuration.noise = 0.5;
    const PixelFit fit = pixels.fitter().fit(pixels.values(7));
    EXPECT_EQ(fit.status, FitStatus::suspect);
    EXPECT_TRUE(std::isnan(fit.sigmas[0]));
}

TEST(PixelFitter, DoubtsAFitWithoutDegreesOfFreedom) {
    Pixels pixels;
    pixels.cube.configuration.wavelength_min_nm = 500;
    pixels.cube.configuration.wavelength_max_nm = 540;
    EXPECT_EQ(pixels.fitter().fit(pixels.values(7)).reason, PixelReason::no_freedom);
}

TEST(PixelFitter, LooksForHemoglobinOnlyInADermis) {
    Pixels pixels;
    pixels.cube.configuration = with_free(pixels.cube.configuration, {Parameter::melanosome_fraction});
    pixels.cube.configuration.layers = 2;
    std::vector<double> values = pixels.values(7);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.2 + 0.01 * static_cast<double>(i);
    EXPECT_NE(pixels.fitter().fit(values).status, FitStatus::rejected);
}

TEST(PixelFitter, RefusesWhatItCannotDo) {
    const Pixels pixels;
    const auto expect_refusal = [&](const std::string& where, const std::function<void(Configuration&)>& change) {
        Configuration configuration = pixels.cube.configuration;
        change(configuration);
        try {
            const PixelFitter fitter(configuration, pixels.common, no_cache());
            FAIL() << where;
        } catch (const InputError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(where)) << error.what();
        }
    };
    expect_refusal("uncertainty", [](Configuration& each) { each.uncertainty = UncertaintyMethod::profile; });
    expect_refusal("loss", [](Configuration& each) { each.loss = Loss::cauchy; });
    expect_refusal("discrepancy", [](Configuration& each) { each.discrepancy = Discrepancy{}; });
    expect_refusal("priors", [](Configuration& each) {
        each.priors[static_cast<std::size_t>(Parameter::oxygen_saturation)] = NormalPrior{.mean = 0.6, .sigma = 0.1};
    });
    expect_refusal("weights", [](Configuration& each) {
        each.weights = {{.range_nm = {.lower = 400, .upper = 500}, .weight = 2.0}};
    });
    expect_refusal("free parameter fibril_radius_nm",
                   [](Configuration& each) { each = with_free(each, {Parameter::fibril_radius_nm}); });
}

}  // namespace
}  // namespace skinfit::test
