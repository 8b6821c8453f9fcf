#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "measurements/spectrum_file.hpp"
#include "measurements/spectrum_writer.hpp"
#include "measurements/text_reader.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

const std::filesystem::path root = SKINFIT_SOURCE_DIR;
const std::filesystem::path shared_spectra = root / "../shared/spectra";

std::string refusal(const std::string& file, const std::optional<std::string>& column = std::nullopt) {
    return test::refusal_of([&] { (void)read_spectrum(shared_spectra / file, {.column = column}); });
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
    EXPECT_NE(refusal("ncsu_vrhel_1994_skin.csv", "ncsu_13").find("the nearest name is \"ncsu_"), std::string::npos);
}

/// The file's lines, cut at every `separator` and nothing more: an independent reading of files without quotes there.
std::vector<std::vector<std::string>> cut(const std::string& file, char separator) {
    std::ifstream stream(shared_spectra / file, std::ios::binary);
    std::vector<std::vector<std::string>> lines;
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string>& cells = lines.emplace_back();
        std::istringstream rest(line);
        for (std::string cell; std::getline(rest, cell, separator);) cells.push_back(cell);
    }
    return lines;
}

double number(const std::string& cell) {
    return std::strtod(cell.c_str(), nullptr);
}

TEST_F(SharedSpectra, NcsuHoldsTwentySpectraWithItsNumbers) {
    const SpectrumFile file = read_spectra(shared_spectra / "ncsu_vrhel_1994_skin.csv");
    const auto lines = cut("ncsu_vrhel_1994_skin.csv", ',');
    EXPECT_EQ(file.format, "columns");
    ASSERT_EQ(file.spectra.size(), 20U);
    for (std::size_t k = 0; k < 20; ++k) {
        const Spectrum& spectrum = file.spectra[k];
        ASSERT_EQ(spectrum.value.size(), lines.size() - 1);
        EXPECT_TRUE(lines[0][k + 1].starts_with(spectrum.name));
        for (std::size_t i = 0; i < spectrum.value.size(); ++i) {
            ASSERT_EQ(spectrum.wavelength_nm[i], number(lines[i + 1][0]));
            ASSERT_EQ(spectrum.value[i], number(lines[i + 1][k + 1]));
        }
    }
}

TEST_F(SharedSpectra, NistHoldsThreeRepeatsAndTheMeanOfFiftySubjects) {
    const SpectrumFile file = read_spectra(shared_spectra / "nist_m38597_odd_subjects.csv");
    const auto lines = cut("nist_m38597_odd_subjects.csv", ',');
    constexpr std::size_t first = 8;  // lines of prose and header before the numbers
    EXPECT_EQ(file.format, "nist_m38597");
    ASSERT_EQ(file.spectra.size(), 200U);
    for (std::size_t k = 0; k < 200; ++k) {
        const Spectrum& spectrum = file.spectra[k];
        const std::string reading = k % 4 == 3 ? "mean" : "R" + std::to_string(k % 4 + 1);
        EXPECT_EQ(spectrum.name, "subject " + std::to_string(2 * (k / 4) + 1) + " " + reading);
        EXPECT_EQ(spectrum.quantity, Quantity::reflectance);
        ASSERT_EQ(spectrum.value.size(), lines.size() - first);
        for (std::size_t i = 0; i < spectrum.value.size(); ++i) {
            ASSERT_EQ(spectrum.wavelength_nm[i], number(lines[i + first][0]));
            ASSERT_EQ(spectrum.value[i], number(lines[i + first][k + 1]));
        }
        EXPECT_EQ(spectrum.repeats.size(), k % 4 == 3 ? 3U : 0U);
        EXPECT_EQ(spectrum.sigma.size(), k % 4 == 3 ? spectrum.value.size() : 0U);
    }
    EXPECT_EQ(file.spectra[3].repeats[1], file.spectra[1].value);
}

TEST_F(SharedSpectra, XiaoHoldsASpectrumInEachRow) {
    const SpectrumFile file = read_spectra(shared_spectra / "xiao_2016_subset.csv");
    const auto lines = cut("xiao_2016_subset.csv", ',');
    EXPECT_EQ(file.format, "rows");
    ASSERT_EQ(file.spectra.size(), 2196U);
    for (std::size_t k = 0; k < 2196; ++k) {
        const Spectrum& spectrum = file.spectra[k];
        EXPECT_EQ(spectrum.name, lines[k + 1][0]);
        EXPECT_EQ(spectrum.line, k + 2);
        ASSERT_EQ(spectrum.value.size(), 39U);
        for (std::size_t i = 0; i < 39; ++i) {
            ASSERT_EQ(spectrum.wavelength_nm[i], number(lines[0][i + 1]));
            ASSERT_EQ(spectrum.value[i], number(lines[k + 1][i + 1]));
        }
    }
}

TEST_F(SharedSpectra, IssaHoldsTenSpectraInPercentWithoutTheirLastFourBands) {
    const SpectrumFile file = read_spectra(shared_spectra / "issa_2025_sample.ti3");
    const auto lines = cut("issa_2025_sample.ti3", ' ');
    const auto begin = std::ranges::find(lines, std::vector<std::string>{"BEGIN_DATA"});
    EXPECT_EQ(file.format, "cgats");
    ASSERT_EQ(file.spectra.size(), 10U);
    for (std::size_t k = 0; k < 10; ++k) {
        const Spectrum& spectrum = file.spectra[k];
        const std::vector<std::string>& cells = *(begin + 1 + static_cast<std::ptrdiff_t>(k));
        EXPECT_EQ(spectrum.name, cells[0]);
        EXPECT_EQ(spectrum.missing_nm.size(), 4U);
        ASSERT_EQ(spectrum.value.size(), 39U);
        for (std::size_t i = 0; i < 39; ++i) {
            ASSERT_EQ(spectrum.wavelength_nm[i], 360.0 + 10.0 * static_cast<double>(i));
            ASSERT_EQ(spectrum.value[i], number(cells[i + 8]) / 100);
        }
    }
}

TEST_F(SharedSpectra, EveryFileConvertsAndReadsBackToTheLastBit) {
    for (const std::string name : {"ncsu_vrhel_1994_skin.csv", "nist_m38597_odd_subjects.csv", "xiao_2016_subset.csv",
                                   "issa_2025_sample.ti3", "eyelid_transmittance_bierman_2011.txt"}) {
        const std::vector<Spectrum> spectra = read_spectra(shared_spectra / name).spectra;
        for (const std::string& text : {spectra_csv(spectra, name), spectra_json(spectra)}) {
            const std::vector<Spectrum> again = parse_spectra(text, name).spectra;
            ASSERT_EQ(again.size(), spectra.size()) << name;
            for (std::size_t k = 0; k < spectra.size(); ++k) {
                EXPECT_EQ(again[k].name, spectra[k].name);
                EXPECT_EQ(again[k].wavelength_nm, spectra[k].wavelength_nm);
                EXPECT_EQ(again[k].value, spectra[k].value);
                EXPECT_EQ(again[k].sigma, spectra[k].sigma);
            }
        }
    }
}

TEST_F(SharedSpectra, LabelsAreNoSpectra) {
    EXPECT_NE(refusal("ncsu_vrhel_1994_labels.csv").find(":2: starts with the word \"ncsu_082"), std::string::npos);
}

}  // namespace
}  // namespace skinfit
