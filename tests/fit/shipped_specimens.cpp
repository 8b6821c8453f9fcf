#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit::test {
namespace {

FitResult fitted(const std::string& specimen, const std::string& also_free) {
    Configuration configuration = default_configuration();
    if (!also_free.empty()) configuration = with_freedom(configuration, also_free, true, "test");
    const Spectrum spectrum = read_spectrum(std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements/data" / specimen);
    const DiskCache no_cache{
        .folder = std::nullopt, .warn = [](const std::string&) {}, .inform = [](const std::string&) {}};
    return fit_spectrum(configuration, spectrum, {.cross_check = false, .cache = no_cache});
}

TEST(ShippedSpecimens, LightSkinIsExplainedByFivePigments) {
    const FitResult result = fitted("ncsu_113.csv", "");
    EXPECT_TRUE(result.answer.minimum.converged);
    EXPECT_LE(result.rmse, 0.008);
}

TEST(ShippedSpecimens, LightSkinIsExplainedBetterWithTheInstrumentsScale) {
    EXPECT_LE(fitted("ncsu_113.csv", "scale").rmse, 0.0045);
}

TEST(ShippedSpecimens, DarkerSkinIsExplainedEitherWay) {
    EXPECT_LE(fitted("ncsu_082.csv", "").rmse, 0.0065);
    EXPECT_LE(fitted("ncsu_082.csv", "scale").rmse, 0.0065);
}

/// The wavelength of the smallest or largest modelled value within [first, last] nm.
double extreme_nm(const FitResult& result, double first, double last, double sign) {
    double best_nm = 0.0;
    double best = -1e9;
    const FittedSpectrum& spectrum = result.spectra.front();
    for (std::size_t i = 0; i < spectrum.wavelength_nm.size(); ++i) {
        const double nm = spectrum.wavelength_nm[i];
        if (nm < first || nm > last || sign * spectrum.modelled[i] <= best) continue;
        best = sign * spectrum.modelled[i];
        best_nm = nm;
    }
    return best_nm;
}

TEST(ShippedSpecimens, ModelledLightSkinShowsTheWOfOxyhaemoglobin) {
    const FitResult result = fitted("ncsu_113.csv", "");
    const double left_nm = extreme_nm(result, 520, 560, -1.0);
    const double peak_nm = extreme_nm(result, 545, 575, +1.0);
    const double right_nm = extreme_nm(result, 560, 600, -1.0);
    EXPECT_GE(left_nm, 540);
    EXPECT_LE(left_nm, 545);
    EXPECT_GE(right_nm, 575);
    EXPECT_LE(right_nm, 580);
    EXPECT_GT(peak_nm, left_nm);
    EXPECT_LT(peak_nm, right_nm);
}

}  // namespace
}  // namespace skinfit::test
