#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "measurements/quality_checks.hpp"
#include "measurements/spectrum_file.hpp"

/// Small files in the forms of instruments and programs, whose headers state what has to be heeded.
namespace skinfit {
namespace {

using Numbers = std::vector<double>;

std::filesystem::path case_file(const std::string& name) {
    return std::filesystem::path(SKINFIT_SOURCE_DIR) / "tests/measurements/cases" / name;
}

std::vector<Spectrum> spectra_in(const std::string& name) {
    return read_spectra(case_file(name)).spectra;
}

Spectrum only_in(const std::string& name) {
    const std::vector<Spectrum> spectra = spectra_in(name);
    EXPECT_EQ(spectra.size(), 1U) << name;
    return spectra.front();
}

Numbers every(double first, double step, std::size_t count) {
    Numbers numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(first + step * static_cast<double>(i));
    return numbers;
}

/// 32-bit numbers, least significant byte first, without any of the project's readers.
Numbers floats_in(const std::string& name) {
    std::ifstream stream(case_file(name), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    Numbers numbers;
    for (std::size_t at = 0; at + sizeof(float) <= bytes.size(); at += sizeof(float)) {
        float number = 0;
        std::memcpy(&number, &bytes[at], sizeof number);
        numbers.push_back(static_cast<double>(number));
    }
    return numbers;
}

/// The mean over pixels of numbers interleaved by pixel, those pixels apart whose first number is `masked`.
Numbers mean_of(const Numbers& numbers, std::size_t bands, double masked) {
    Numbers mean(bands, 0.0);
    double pixels = 0;
    for (std::size_t pixel = 0; pixel < numbers.size() / bands; ++pixel) {
        if (numbers[pixel * bands] == masked) continue;
        ++pixels;
        for (std::size_t band = 0; band < bands; ++band) mean[band] += numbers[pixel * bands + band];
    }
    for (double& sum : mean) sum /= pixels;
    return mean;
}

void expect_near(const Numbers& found, const Numbers& expected, double tolerance) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << i;
}

constexpr double rounding = 1e-12;  // of sums of 30 numbers below 1 in another order

TEST(StatedInFiles, GainsAndOffsetsOfACubeAreApplied) {
    const Spectrum arm = only_in("envi_gains_and_offsets/arm.hdr");
    Numbers expected = mean_of(floats_in("envi_gains_and_offsets/arm.img"), 61, 0);
    for (double& value : expected) value -= 0.05;
    expect_near(arm.value, expected, rounding);
    EXPECT_NEAR(arm.value.front(), 0.085, 0.0005);
    EXPECT_NEAR(arm.value.back(), 0.42, 0.005);
    EXPECT_EQ(arm.unit_rule.substr(0, 8), "fraction");
}

TEST(StatedInFiles, BytesBeyondThoseThatAHeaderPromisesAreAWarning) {
    const Spectrum arm = only_in("envi_data_longer_than_header/arm.hdr");
    const std::optional<Finding> finding = doubtful_file(arm);
    ASSERT_TRUE(finding);
    EXPECT_EQ(finding->severity, Severity::warning);
    EXPECT_EQ(finding->message,
              "arm.img has 7328 bytes, 8 more than its header promises; if any stand in front of the numbers, all "
              "values belong to other bands or pixels");
}

TEST(StatedInFiles, PixelsMaskedByZerosAreLeftOutAndCounted) {
    const Spectrum cheek = only_in("envi_masked_pixels/cheek.hdr");
    expect_near(cheek.value, mean_of(floats_in("envi_masked_pixels/cheek.img"), 61, 0), rounding);
    EXPECT_NEAR(cheek.value.front(), 0.162, 0.0005);
    EXPECT_NEAR(cheek.value.back(), 0.58, 0.005);
    const std::optional<Finding> finding = as_read(cheek);
    ASSERT_TRUE(finding);
    EXPECT_EQ(finding->severity, Severity::note);
    EXPECT_EQ(finding->message,
              "5 of 30 pixels are left out: 5 have no number, or the same one in all bands, such as 0");
}

TEST(StatedInFiles, HeadersMayBeLaidOutInManyWays) {
    for (const std::string name : {"brace_below", "commas_first", "bom"}) {
        const Spectrum arm = only_in("envi_header_layouts/" + name + ".hdr");
        EXPECT_EQ(arm.wavelength_nm, every(400, 5, 61)) << name;
        expect_near(arm.value, mean_of(floats_in("envi_header_layouts/" + name + ".img"), 61, 0), rounding);
    }
}

TEST(StatedInFiles, ASpectralLibraryHoldsASpectrumInEveryLine) {
    const Numbers numbers = floats_in("envi_spectral_library/skin.sli");
    for (const std::string name : {"skin.hdr", "skin.sli"}) {
        const std::vector<Spectrum> spectra = spectra_in("envi_spectral_library/" + name);
        ASSERT_EQ(spectra.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(spectra[i].name, (std::array<std::string, 3>{"forearm", "back", "cheek"}[i]));
            EXPECT_EQ(spectra[i].wavelength_nm, every(400, 5, 61));
            const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(61 * i);
            EXPECT_EQ(spectra[i].value, Numbers(first, first + 61));
        }
    }
}

TEST(StatedInFiles, WavelengthsWithoutAUnitAreTakenByTheirSizeAndIgnoredPixelsLeftOut) {
    for (const std::string name : {"none", "unknown", "micro", "ignore"}) {
        const Spectrum arm = only_in("envi_units_missing/" + name + ".hdr");
        expect_near(arm.wavelength_nm, every(400, 5, 61), 1e-9);
        expect_near(arm.value, mean_of(floats_in("envi_units_missing/" + name + ".img"), 61, -9999), rounding);
        EXPECT_EQ(as_read(arm).has_value(), name == "ignore");
    }
}

TEST(StatedInFiles, ABlockOfCountsDoesNotHideTheReflectanceBesideIt) {
    const Spectrum forearm = only_in("jcamp_counts_beside_reflectance/forearm.jdx");
    EXPECT_EQ(forearm.wavelength_nm, every(380, 3, 140));
    EXPECT_EQ(forearm.value.front(), 8.048 / 100);
    EXPECT_EQ(forearm.quantity, Quantity::reflectance);
    const std::optional<Finding> finding = as_read(forearm);
    ASSERT_TRUE(finding);
    EXPECT_TRUE(finding->message.starts_with("2 of the file's spectra are left out: ")) << finding->message;
    EXPECT_NE(finding->message.find("171: ##YUNITS= is \"COUNTS\""), std::string::npos) << finding->message;
    EXPECT_FALSE(doubtful_file(forearm));
    const Spectrum reflection = only_in("jcamp_counts_beside_reflectance/reflection.jdx");
    EXPECT_EQ(reflection.wavelength_nm, forearm.wavelength_nm);
    EXPECT_EQ(reflection.value, forearm.value);
    EXPECT_EQ(reflection.quantity, Quantity::reflectance);
}

TEST(StatedInFiles, DecimalCommasOfJcampAreRead) {
    const Spectrum commas = only_in("jcamp_decimal_commas/forearm.jdx");
    const Spectrum points = only_in("jcamp_counts_beside_reflectance/forearm.jdx");
    EXPECT_EQ(commas.wavelength_nm, points.wavelength_nm);
    EXPECT_EQ(commas.value, points.value);
    EXPECT_FALSE(doubtful_file(commas));
}

TEST(StatedInFiles, PairsAreReadAsPairsWhateverTheClassOfTheFile) {
    const Spectrum forearm = only_in("jcamp_pairs_under_xydata/forearm.jdx");
    ASSERT_EQ(forearm.wavelength_nm.size(), 31U);
    EXPECT_EQ(Numbers(forearm.wavelength_nm.begin(), forearm.wavelength_nm.begin() + 8),
              (Numbers{400, 410, 420, 430, 440, 453, 460, 473}));
    EXPECT_EQ(forearm.value[5], 0.1115);
}

TEST(StatedInFiles, FieldsOfCgatsHaveManyNames) {
    const Spectrum pairs = only_in("cgats_names_of_fields/pairs.cgats");
    const Spectrum plain = only_in("cgats_names_of_fields/plain.cgats");
    const std::vector<Spectrum> names = spectra_in("cgats_names_of_fields/names.cgats");
    ASSERT_EQ(names.size(), 2U);
    EXPECT_EQ(names[0].name, "left forearm");
    EXPECT_EQ(names[1].name, "right cheek");
    for (const Spectrum& spectrum : {pairs, plain, names[0], names[1]}) {
        EXPECT_EQ(spectrum.wavelength_nm, every(380, 10, 36));
    }
    EXPECT_EQ(plain.value.front(), 0.0810);
    EXPECT_EQ(plain.value.back(), 0.4519);
    expect_near(pairs.value, plain.value, 1e-9);
    EXPECT_EQ(names[0].value, plain.value);
    EXPECT_EQ(names[1].value.front(), 0.0794);
}

TEST(StatedInFiles, QtxHoldsAStandardAndABatch) {
    const std::vector<Spectrum> spectra = spectra_in("qtx/skin.qtx");
    ASSERT_EQ(spectra.size(), 2U);
    EXPECT_EQ(spectra[0].name, "forearm");
    EXPECT_EQ(spectra[1].name, "cheek");
    for (const Spectrum& spectrum : spectra) {
        EXPECT_EQ(spectrum.wavelength_nm, every(400, 10, 31));
        EXPECT_EQ(spectrum.quantity, Quantity::reflectance);
    }
    EXPECT_EQ(spectra[0].value.front(), 8.424965 / 100);
    EXPECT_EQ(spectra[1].value.back(), 40.115675 / 100);
    EXPECT_EQ(spectra[0].geometry.specular, Specular::included);
    EXPECT_EQ(spectra[1].geometry.specular, std::nullopt);
}

}  // namespace
}  // namespace skinfit
