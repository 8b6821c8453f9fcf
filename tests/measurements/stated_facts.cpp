#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "measurements/spectrum_building.hpp"
#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

/// Files that state what they hold: each in the folder of `cases` that is called by what it states.
namespace skinfit {
namespace {

const std::filesystem::path cases = std::filesystem::path(SKINFIT_SOURCE_DIR) / "tests/measurements/cases";

SpectrumFile read(const std::string& file, const std::optional<std::string>& column = {}) {
    return read_spectra(cases / file, {.column = column});
}

Spectrum only(const std::string& file, const std::optional<std::string>& column = {}) {
    SpectrumFile all = read(file, column);
    EXPECT_EQ(all.spectra.size(), 1U) << file;
    return all.spectra.front();
}

std::string refusal(const std::string& file, const std::optional<std::string>& column = {}) {
    return test::refusal_of([&] { (void)read(file, column); });
}

double value_at(const Spectrum& spectrum, double nm) {
    const auto found = std::ranges::find(spectrum.wavelength_nm, nm);
    return found == spectrum.wavelength_nm.end()
               ? -1
               : spectrum.value[static_cast<std::size_t>(found - spectrum.wavelength_nm.begin())];
}

bool is_told(const Spectrum& spectrum, std::string_view words) {
    return std::ranges::any_of(spectrum.remarks,
                               [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

void expect_range(const Spectrum& spectrum, std::size_t readings, double first_nm, double last_nm) {
    EXPECT_EQ(spectrum.value.size(), readings);
    EXPECT_DOUBLE_EQ(spectrum.wavelength_nm.front(), first_nm);
    EXPECT_DOUBLE_EQ(spectrum.wavelength_nm.back(), last_nm);
}

TEST(StatedQuantity, IsRefusedWhereItIsNeitherReflectanceNorTransmittance) {
    const std::string jasco = refusal("absorbance_in_preamble/forearm.txt");
    EXPECT_NE(jasco.find("\"YUNITS ABSORBANCE\""), std::string::npos) << jasco;
    EXPECT_NE(jasco.find("forearm.txt:11"), std::string::npos) << jasco;
    EXPECT_NE(jasco.find("10^-A"), std::string::npos) << jasco;
    for (const auto& [file, word] :
         {std::pair("absorbance", "\"Absorbance\""), {"logR", "\"log(1/R)\""}, {"ks", "\"K/S\""}}) {
        const std::string message = refusal(std::string("absorbance_in_header/") + file + ".csv");
        EXPECT_NE(message.find(word), std::string::npos) << message;
    }
}

TEST(StatedQuantity, OfARowIsThatOfItsLabel) {
    const SpectrumFile specimen = read("quantity_in_label/specimen.csv");
    ASSERT_EQ(specimen.spectra.size(), 2U);
    EXPECT_EQ(specimen.spectra[0].quantity, Quantity::transmittance);
    EXPECT_EQ(specimen.spectra[1].quantity, Quantity::reflectance);
    EXPECT_DOUBLE_EQ(specimen.spectra[0].value.front(), 0.0264333);
    EXPECT_DOUBLE_EQ(specimen.spectra[1].value.front(), 0.1523277);
    EXPECT_TRUE(is_told(specimen.spectra[0], "left out: 1 of 3 spectra"));
    EXPECT_NE(refusal("quantity_in_label/specimen.csv", "3").find("\"Absorbance\""), std::string::npos);
}

TEST(StatedQuantity, LeavesRawSignalsOutAndKeepsTheNumbersOfColumns) {
    const Spectrum arm = only("raw_signal_columns/arm.sed");
    EXPECT_EQ(arm.quantity, Quantity::reflectance);
    EXPECT_EQ(arm.unit_rule, "fraction: stated by the header");
    EXPECT_EQ(value_at(arm, 400), 0.08542);
    EXPECT_TRUE(is_told(arm, "\"Norm. DN (Ref.)\", \"Norm. DN (Target)\""));
    EXPECT_EQ(only("raw_signal_columns/arm.sed", "3").value, arm.value);
    EXPECT_NE(refusal("raw_signal_columns/arm.sed", "2").find("\"Norm. DN (Target)\""), std::string::npos);
    expect_range(only("two_header_lines/avasoft.ttt", "4"), 330, 400.29, 696.39);
}

TEST(StatedAbscissa, IsConvertedFromFrequencyAndWavenumber) {
    const Spectrum thz = only("frequency_and_wavenumber/thz.csv");
    expect_range(thz, 160, 299792.458 / 748, 299792.458 / 430);
    EXPECT_EQ(thz.value.back(), 0.41946);
    EXPECT_TRUE(is_told(thz, "430 to 748 THz"));
    const Spectrum ftir = only("frequency_and_wavenumber/ftir.csv");
    expect_range(ftir, 350, 1e7 / 2396, 10000);
    EXPECT_TRUE(is_told(ftir, "1/cm"));
}

TEST(StatedAbscissa, IsTheColumnCalledWavelength) {
    for (const std::string name : {"selected", "from_zero"}) {
        const Spectrum spectrum = only("index_in_front/" + name + ".csv");
        expect_range(spectrum, name == "selected" ? 369 : 93, 450, 818);
        EXPECT_EQ(value_at(spectrum, 450), 0.11481);
        EXPECT_EQ(only("index_in_front/" + name + ".csv", "reflectance").value, spectrum.value);
    }
}

TEST(StatedAbscissa, OfEachPairOfColumnsIsItsOwn) {
    const SpectrumFile scans = read("paired_columns/two_scans.csv");
    ASSERT_EQ(scans.spectra.size(), 2U);
    EXPECT_EQ(scans.spectra[0].name, "forearm");
    EXPECT_EQ(scans.spectra[1].name, "cheek");
    expect_range(scans.spectra[0], 329, 390.9832, 720);
    expect_range(scans.spectra[1], 329, 372, 700);
    EXPECT_DOUBLE_EQ(scans.spectra[1].value.back(), 0.5810184944);
    EXPECT_EQ(only("paired_columns/two_scans.csv", "3").value, scans.spectra[1].value);
    EXPECT_EQ(only("paired_columns/two_scans.csv", "cheek").wavelength_nm, scans.spectra[1].wavelength_nm);
    EXPECT_NE(refusal("paired_columns/two_scans.csv", "2").find("holds wavelengths"), std::string::npos);
}

TEST(StatedAbscissa, InTheHeaderMakesRowsWhateverTheCornerSays) {
    const std::pair<std::string, std::size_t> tables[] = {{"participants", 30}, {"names", 3}, {"small_ids", 24}};
    for (const auto& [name, count] : tables) {
        const SpectrumFile file = read("wavelength_in_corner/" + name + ".tsv");
        EXPECT_EQ(file.format, "rows");
        ASSERT_EQ(file.spectra.size(), count);
        expect_range(file.spectra.front(), 31, 400, 700);
        EXPECT_EQ(value_at(file.spectra.front(), 400), 0.086);
    }
    for (const std::string name : {"numbered", "r_table"}) {
        const SpectrumFile file = read("prefixed_wavelengths/" + name + ".csv");
        ASSERT_EQ(file.spectra.size(), 3U);
        expect_range(file.spectra[2], 31, 400, 700);
        EXPECT_EQ(value_at(file.spectra[2], 700), 0.5816);
    }
}

TEST(StatedSpecular, OfARowIsThatOfItsLabelAndTellsNamesApart) {
    const SpectrumFile forearm = read("specular_in_label/forearm.csv");
    ASSERT_EQ(forearm.spectra.size(), 2U);
    EXPECT_EQ(forearm.spectra[0].name, "forearm 1 SCI");
    EXPECT_EQ(forearm.spectra[0].geometry.specular, Specular::included);
    EXPECT_EQ(forearm.spectra[1].name, "forearm 1 SCE");
    EXPECT_EQ(forearm.spectra[1].geometry.specular, Specular::excluded);
    EXPECT_EQ(only("specular_in_label/forearm.csv", "2").geometry.specular, Specular::excluded);
}

TEST(StatedUnit, IsOneForATable) {
    const SpectrumFile scan = read("unit_of_table/scan.csv");
    ASSERT_EQ(scan.spectra.size(), 3U);
    EXPECT_DOUBLE_EQ(value_at(scan.spectra[0], 400), 0.0855);
    EXPECT_DOUBLE_EQ(value_at(scan.spectra[1], 400), 0.0075);
    EXPECT_DOUBLE_EQ(value_at(scan.spectra[2], 400), 0.0150);
    EXPECT_EQ(only("unit_of_table/scan.csv", "black hair").value, scan.spectra[1].value);
    EXPECT_NE(scan.spectra[1].unit_rule.find("\"forearm\" is in percent"), std::string::npos);
}

TEST(StatedUncertainty, IsThatOfTheColumnItNames) {
    for (const std::string name : {"sd", "savetxt"}) {
        const Spectrum spectrum = only("named_uncertainties/" + name + ".csv");
        EXPECT_EQ(spectrum.sigma, std::vector<double>(31, 0.02)) << name;
    }
    EXPECT_EQ(only("named_uncertainties/sd.csv", "R").sigma_source, "given by the file as R_sd");
}

TEST(FilledValues, AreMissingInTheSpellingOfOldWindows) {
    const Spectrum percent = only("windows_nan/percent.csv");
    EXPECT_EQ(percent.missing_nm.size(), 2U);
    EXPECT_EQ(value_at(percent, 400), -1);
    EXPECT_DOUBLE_EQ(value_at(percent, 420), 0.0896);
    const Spectrum fraction = only("windows_nan/fraction.csv");
    EXPECT_EQ(fraction.missing_nm.size(), 2U);
    EXPECT_EQ(value_at(fraction, 500), -1);
    EXPECT_EQ(value_at(fraction, 360), -1);
}

TEST(TextAroundATable, IsNoReading) {
    expect_range(only("log_below_numbers/forearm.csv"), 329, 390.9832, 720);
    expect_range(only("end_marker/forearm.txt"), 578, 380, 818.52);
    expect_range(only("digits_in_preamble/asd.tsv"), 221, 360, 800);
    expect_range(only("digits_in_preamble/li1800.prn"), 151, 400, 700);
    EXPECT_EQ(read("two_header_lines/times.csv").spectra[1].name, "2024-05-06 10:05:00");
}

TEST(OverlappingDetectors, KeepTheReadingsOfTheFirst) {
    const Spectrum arm = only("overlapping_detectors/arm.sig");
    expect_range(arm, 377, 350, 1108.6);
    EXPECT_DOUBLE_EQ(arm.value.front(), 0.0742);
    EXPECT_TRUE(is_told(arm, "12 readings between 968.2 and 1007.8 nm"));
    EXPECT_EQ(only("overlapping_detectors/arm.sig", "3").value, arm.value);
}

/// 585 in place of 545: no second detector, and no reading is left out.
TEST(OverlappingDetectors, AreMoreThanOneWavelengthOutOfPlace) {
    std::vector<double> wavelengths;
    for (int i = 0; i <= 60; ++i) wavelengths.push_back(400 + 5 * i);
    wavelengths[29] = 585;
    const Grid grid = make_grid(wavelengths, [](std::size_t) { return GridPlace{}; });
    EXPECT_EQ(grid.order.size(), wavelengths.size());
    EXPECT_EQ(grid.remark, "");
    ASSERT_EQ(grid.repeated.size(), 1U);
    EXPECT_EQ(grid.repeated.front().wavelength_nm, 585);
}

}  // namespace
}  // namespace skinfit
