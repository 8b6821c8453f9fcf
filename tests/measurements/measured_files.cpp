#include <gtest/gtest.h>

#include <filesystem>

#include "core/input_error.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {
namespace {

const std::filesystem::path root = SKINFIT_SOURCE_DIR;
const std::filesystem::path shared_spectra = root / "../shared/spectra";

std::string refusal(const std::string& file, const std::optional<std::string>& column = std::nullopt) {
    try {
        (void)read_spectrum(shared_spectra / file, {.column = column});
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ShippedSpecimens, AreReadWithTheirGeometry) {
    for (const std::string number : {"082", "113"}) {
        const Spectrum spectrum = read_spectrum(root / "measurements/data" / ("ncsu_" + number + ".csv"));
        EXPECT_EQ(spectrum.wavelength_nm.size(), 69U);
        EXPECT_EQ(spectrum.wavelength_nm.front(), 390);
        EXPECT_EQ(spectrum.wavelength_nm.back(), 730);
        EXPECT_EQ(spectrum.quantity, Quantity::reflectance);
        EXPECT_EQ(spectrum.geometry.incidence_deg, 45.0);
        EXPECT_EQ(spectrum.geometry.specular, Specular::excluded);
        EXPECT_TRUE(spectrum.name.starts_with("NCSU ")) << spectrum.name;
        EXPECT_EQ(spectrum.unit_rule, "fraction: stated by a comment in the file");
    }
}

class SharedSpectra : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(shared_spectra)) GTEST_SKIP() << "../shared is absent";
    }
};

TEST_F(SharedSpectra, TheShippedSpecimensAreTheirWideFileAtEveryTenNanometres) {
    for (const std::string number : {"082", "113"}) {
        const Spectrum shipped = read_spectrum(root / "measurements/data" / ("ncsu_" + number + ".csv"));
        const Spectrum wide = read_spectrum(shared_spectra / "ncsu_vrhel_1994_skin.csv", {.column = "ncsu_" + number});
        EXPECT_EQ(wide.name, "ncsu_" + number);
        ASSERT_EQ(wide.wavelength_nm.size(), 171U);
        for (std::size_t i = 0; i < shipped.value.size(); i += 2) {  // 10 nm: a line of both files, not interpolated
            const std::size_t j = i / 2 * 5;
            ASSERT_EQ(shipped.wavelength_nm[i], wide.wavelength_nm[j]);
            EXPECT_EQ(shipped.value[i], wide.value[j]) << shipped.wavelength_nm[i];
        }
    }
}

TEST_F(SharedSpectra, TheEyelidIsReadWithoutAHeader) {
    const Spectrum eyelid = read_spectrum(shared_spectra / "eyelid_transmittance_bierman_2011.txt");
    ASSERT_EQ(eyelid.wavelength_nm.size(), 251U);
    for (std::size_t i = 0; i < 251; ++i) EXPECT_EQ(eyelid.wavelength_nm[i], 450.0 + static_cast<double>(i));
    EXPECT_EQ(eyelid.value.front(), 8.1625488e-4);
    EXPECT_EQ(eyelid.value.back(), 1.1806709e-1);
    EXPECT_EQ(eyelid.name, "eyelid_transmittance_bierman_2011");
    EXPECT_EQ(eyelid.quantity, std::nullopt);
}

TEST_F(SharedSpectra, AWideFileNeedsAChoice) {
    EXPECT_NE(refusal("ncsu_vrhel_1994_skin.csv").find(":1: has 20 columns of values (ncsu_082, "), std::string::npos);
    EXPECT_NE(refusal("ncsu_vrhel_1994_skin.csv", "ncsu_13").find("the nearest name is 'ncsu_"), std::string::npos);
}

TEST_F(SharedSpectra, LabelsAreNoSpectra) {
    EXPECT_NE(refusal("ncsu_vrhel_1994_labels.csv").find(":2: starts with the word 'ncsu_082"), std::string::npos);
}

}  // namespace
}  // namespace skinfit
