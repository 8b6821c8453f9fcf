#include "study/spectrum_fitter.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "fit/fit.hpp"
#include "fit/inspection.hpp"
#include "fit/report.hpp"
#include "measurements/spectrum_file.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit {
namespace {

using test::no_cache;

Spectrum shipped() {
    const std::filesystem::path folder = std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements" / "data";
    return read_spectra(folder / "ncsu_113.csv").spectra.at(0);
}

/// One reading stands out.
Spectrum spiked() {
    Spectrum spectrum = shipped();
    spectrum.value[30] += 0.1;
    return spectrum;
}

Study plain_study() {
    Study study;
    study.file = "study.json";
    return study;
}

/// The fitter that all tests share: its emulator is made once.
SpectrumFitter& fitter() {
    static const Study study = plain_study();
    static SpectrumFitter shared(study, no_cache());
    return shared;
}

void expect_result(const StudiedSpectrum& studied, const FitResult& result) {
    EXPECT_EQ(studied.verdict, name_of(result.verdict));
    std::string reasons;
    for (const std::string& reason : result.reasons) reasons += (reasons.empty() ? "" : " | ") + reason;
    EXPECT_EQ(studied.reason, reasons);
    ASSERT_EQ(studied.parameters.size(), result.free.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const ParameterEstimate& estimate = studied.parameters[i];
        const FittedParameter& free = result.free[i];
        EXPECT_EQ(estimate.name, free.name);
        EXPECT_EQ(estimate.value, free.value);
        EXPECT_EQ(estimate.sigma, free.uncertainty.sigma);
        EXPECT_EQ(estimate.interval_95.lower, free.uncertainty.interval_95.lower);
        EXPECT_EQ(estimate.interval_95.upper, free.uncertainty.interval_95.upper);
        EXPECT_EQ(estimate.bounds.lower, free.bounds.lower);
        EXPECT_EQ(estimate.bounds.upper, free.bounds.upper);
        EXPECT_EQ(estimate.status, free.uncertainty.status);
        for (std::size_t k = 0; k < i; ++k) {
            EXPECT_EQ(studied.correlation.at(next++),
                      result.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
        }
    }
    EXPECT_EQ(studied.correlation.size(), next);
    EXPECT_EQ(studied.rmse, result.rmse);
    EXPECT_EQ(studied.chi2, result.chi2);
    EXPECT_EQ(studied.degrees_of_freedom, result.degrees_of_freedom);
    EXPECT_EQ(studied.p_value, result.p_value);
}

TEST(SpectrumFitter, IsTheFitOfOneSpectrumToTheBit) {
    const Spectrum spectrum = shipped();
    const Study study = plain_study();
    const Configuration& configuration = study.configuration;
    const std::vector<Finding> findings = findings_before_fit(configuration, {&spectrum, 1});
    const FitResult result = fit_spectrum(configuration, spectrum, {.cache = no_cache(), .findings = findings});
    const StudiedSpectrum studied = fitter().fit(spectrum);
    EXPECT_TRUE(has_answer(studied.status)) << studied.reason;
    expect_result(studied, result);
    ASSERT_FALSE(studied.parameters.empty());
    EXPECT_EQ(studied.indices.size(), 3U);
    EXPECT_GT(studied.seconds, 0.0);
    Spectrum other = spectrum;
    other.value[10] *= 1.0001;
    EXPECT_NE(fitter().fit(other).chi2, studied.chi2);
}

TEST(SpectrumFitter, DoesNotDependOnThreadsOrOrder) {
    std::vector<Spectrum> spectra(4, shipped());
    for (std::size_t i = 0; i < spectra.size(); ++i) spectra[i].value[20] *= 1.0 + 0.001 * static_cast<double>(i);
    std::vector<StudiedSpectrum> alone;
    for (const Spectrum& spectrum : spectra) alone.push_back(fitter().fit(spectrum));
    std::vector<StudiedSpectrum> together(spectra.size());
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = spectra.size(); i-- > 0;) {
            threads.emplace_back([&, i] { together[i] = fitter().fit(spectra[i]); });
        }
    }
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        together[i].seconds = alone[i].seconds = 0.0;
        EXPECT_EQ(to_json(together[i]).dump(), to_json(alone[i]).dump());
    }
    EXPECT_NE(to_json(alone[0]).dump(), to_json(alone[1]).dump());
}

TEST(SpectrumFitter, RejectsWhatNoFitCouldTrust) {
    const StudiedSpectrum studied = fitter().fit(spiked());
    EXPECT_EQ(studied.status, FitStatus::rejected);
    EXPECT_EQ(studied.reason.find("spikes: 1 reading lies beyond both neighbours"), 0U) << studied.reason;
    EXPECT_TRUE(studied.parameters.empty());
    EXPECT_FALSE(studied.chi2);
}

TEST(SpectrumFitter, FitsWhatTheStudyAccepts) {
    Study study = plain_study();
    study.accept = {"spikes"};
    const StudiedSpectrum studied = SpectrumFitter(study, no_cache()).fit(spiked());
    EXPECT_EQ(studied.status, FitStatus::suspect) << studied.reason;
    EXPECT_EQ(studied.reason.find("SPECTRUM IN DOUBT: spikes"), 0U) << studied.reason;
    EXPECT_FALSE(studied.parameters.empty());
}

TEST(SpectrumFitter, WhatCannotBeFittedHasFailedAndSaysWhy) {
    Spectrum spectrum = shipped();
    spectrum.sigma.assign(spectrum.value.size(), 0.01);
    spectrum.sigma[3] = 0.0;
    EXPECT_EQ(fitter().fit(spectrum).status, FitStatus::rejected);
    Study accepting = plain_study();
    accepting.accept = {"unusable_uncertainty"};
    const StudiedSpectrum studied = SpectrumFitter(accepting, no_cache()).fit(spectrum);
    EXPECT_EQ(studied.status, FitStatus::failed);
    EXPECT_NE(studied.reason.find("sigma is 0 at 405 nm (a standard uncertainty is above 0)"), std::string::npos)
        << studied.reason;
    Spectrum few = shipped();
    few.wavelength_nm.resize(2);
    few.value.resize(2);
    EXPECT_EQ(fitter().fit(few).status, FitStatus::failed);
    EXPECT_EQ(fitter().fit(few).verdict, "");
}

}  // namespace
}  // namespace skinfit
