#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "model/chromophores.hpp"
#include "model/path_ensemble.hpp"
#include "tests/support/reference_spectrum.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

/// What an engine finds at each wavelength; the surface's share is part of the reflectance.
struct Found {
    std::vector<test::Estimate> reflectance;
    std::vector<test::Estimate> transmittance;
};

Found walk(const test::ReferenceSpectrum& reference, const Sample& sample) {
    Found found;
    for (const WalkCounts& counts :
         random_walk(sample, reference.wavelengths_nm,
                     {.incidence_rad = reference.incidence_rad, .rays = 1'000'000, .seed = 8})) {
        found.reflectance.push_back(
            test::share_of(counts.surface_reflected + counts.subsurface_reflected, counts.rays));
        found.transmittance.push_back(test::share_of(counts.transmitted, counts.rays));
    }
    return found;
}

Found ensemble(const test::ReferenceSpectrum& reference, const Sample& sample) {
    const PathEnsemble paths = PathEnsemble::trace(
        sample, reference.wavelengths_nm, {.incidence_rad = reference.incidence_rad, .rays = 200'000, .seed = 9});
    std::vector<PerLayer<double>> depths;
    for (const double wavelength_nm : reference.wavelengths_nm) {
        depths.push_back(optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition)));
    }
    Found found;
    for (const EnsembleResponse& response : paths.respond(depths)) {
        const Escape& top = response[Side::top];
        const Escape& bottom = response[Side::bottom];
        found.reflectance.push_back({paths.surface_share() + top.share, top.standard_error});
        found.transmittance.push_back({bottom.share, bottom.standard_error});
    }
    return found;
}

using Engine = Found (*)(const test::ReferenceSpectrum&, const Sample&);

double p_value(Engine engine, const test::ReferenceSpectrum& reference, const Sample& sample) {
    const Found found = engine(reference, sample);
    std::vector<double> z;
    for (std::size_t i = 0; i < reference.wavelengths_nm.size(); ++i) {
        z.push_back(test::z_between(found.reflectance[i], reference.reflectance[i]));
        z.push_back(test::z_between(found.transmittance[i], reference.transmittance[i]));
    }
    return test::family_wise_p_value(z);
}

void expect_agreement(Engine engine, const std::filesystem::path& folder, std::size_t at_least) {
    const std::vector<test::ReferenceSpectrum> references = test::load_reference_spectra(folder);
    EXPECT_GE(references.size(), at_least);
    for (const test::ReferenceSpectrum& reference : references) {
        EXPECT_GT(p_value(engine, reference, reference.sample), test::passing_p_value) << reference.name;
    }
}

void expect_shared_agreement(Engine engine) {
    const std::filesystem::path folder = test::shared_folder() / "reference";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "../shared is absent";
    expect_agreement(engine, folder, 1);
}

TEST(References, WalkAgreesWithTheKeptOnes) {
    expect_agreement(walk, test::test_data_folder(), 2);
}

TEST(References, EnsembleAgreesWithTheKeptOnes) {
    expect_agreement(ensemble, test::test_data_folder(), 2);
}

TEST(References, WalkAgreesWithAllInShared) {
    expect_shared_agreement(walk);
}

TEST(References, EnsembleAgreesWithAllInShared) {
    expect_shared_agreement(ensemble);
}

TEST(References, SurfaceReflectanceIsFresnels) {
    for (const test::ReferenceSpectrum& reference : test::load_reference_spectra(test::test_data_folder())) {
        const FresnelInterface surface(1.0, reference.sample.skin.stratum_corneum_refractive_index);
        const test::Estimate expected{surface.reflectance(std::cos(reference.incidence_rad)), 0.0};
        std::vector<double> z;
        for (const test::Estimate& found : reference.surface_reflectance) z.push_back(z_between(found, expected));
        EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value) << reference.name;
    }
}

TEST(References, FivePercentMoreMelanosomesAreSeen) {
    for (const test::ReferenceSpectrum& reference : test::load_reference_spectra(test::test_data_folder())) {
        Sample darker = reference.sample;
        darker.skin.melanosome_fraction *= 1.05;
        EXPECT_LT(p_value(walk, reference, darker), test::passing_p_value) << reference.name;
        EXPECT_LT(p_value(ensemble, reference, darker), test::passing_p_value) << reference.name;
    }
}

}  // namespace
}  // namespace skinfit
