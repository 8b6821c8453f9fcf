#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "measurements/quality.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {
namespace {

using Names = std::set<std::string>;

/// The checks that find something, and the spectra on which they do.
class SharedSets : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(shared_)) GTEST_SKIP() << "../shared is absent";
    }

    [[nodiscard]] std::vector<Spectrum> spectra(const std::string& file) const {
        return read_spectra(shared_ / file).spectra;
    }

    [[nodiscard]] static std::map<std::string, Names> found(const std::vector<Spectrum>& spectra) {
        std::map<std::string, Names> names;
        for (const Finding& finding : quality_findings(spectra, {.lowest_nm = 250, .highest_nm = 820})) {
            names[finding.name].insert(finding.spectrum);
        }
        return names;
    }

private:
    std::filesystem::path shared_ = std::filesystem::path(SKINFIT_SOURCE_DIR) / "../shared/spectra";
};

/// The reading at one of the spectrum's wavelengths.
double at(const Spectrum& spectrum, double wavelength_nm) {
    const auto found = std::ranges::find(spectrum.wavelength_nm, wavelength_nm);
    return spectrum.value.at(static_cast<std::size_t>(found - spectrum.wavelength_nm.begin()));
}

TEST_F(SharedSets, NothingIsFoundOnTheSkinOfVrhel) {
    EXPECT_TRUE(found(spectra("ncsu_vrhel_1994_skin.csv")).empty());
}

TEST_F(SharedSets, OfTheSkinOfCookseyOnlyTheInfraredLiesOutsideTheTables) {
    const auto names = found(spectra("nist_m38597_odd_subjects.csv"));
    ASSERT_EQ(names.size(), 1U) << names.begin()->first;
    EXPECT_EQ(names.at("outside_tables").size(), 200U);
}

TEST_F(SharedSets, TheBadSpectraOfXiaoAreFoundAndNoOthers) {
    const std::vector<Spectrum> set = spectra("xiao_2016_subset.csv");
    ASSERT_EQ(set.size(), 2196U);
    Names halved;
    Names at_the_short_end;
    Names lost_a_quarter;
    Names dark;
    std::map<std::vector<double>, Names> equal;
    for (const Spectrum& spectrum : set) {
        const double rest = at(spectrum, 740) / at(spectrum, 720);
        if (rest < 0.5) halved.insert(spectrum.name);
        if (rest >= 0.5 && at(spectrum, 360) < at(spectrum, 380) / 3) at_the_short_end.insert(spectrum.name);
        if (rest >= 0.5 && rest < 0.75) lost_a_quarter.insert(spectrum.name);
        if (std::ranges::max(spectrum.value) < 0.09) dark.insert(spectrum.name);
        equal[spectrum.value].insert(spectrum.name);
    }
    Names twins;
    for (const auto& [values, names] : equal) {
        if (names.size() > 1) twins.insert(names.begin(), names.end());
    }
    // Of the 4392 spectra of which these are half.
    EXPECT_EQ(halved.size(), 12U);
    EXPECT_EQ(at_the_short_end.size(), 3U);
    EXPECT_EQ(lost_a_quarter.size(), 14U);
    EXPECT_EQ(twins.size(), 12U);
    halved.insert(at_the_short_end.begin(), at_the_short_end.end());

    const auto names = found(set);
    EXPECT_EQ(names.size(), 6U);
    EXPECT_EQ(names.at("collapse_at_end"), halved);
    EXPECT_EQ(names.at("falling_end"), lost_a_quarter);
    EXPECT_EQ(names.at("duplicate"), twins);
    EXPECT_EQ(names.at("dark_everywhere"), dark);
    EXPECT_EQ(names.at("offset"),
              (Names{"1847", "2263", "2265", "2291", "2293", "2295", "2377", "2937", "3005", "3923"}));
    EXPECT_EQ(names.at("no_hemoglobin"), (Names{"2153", "3603", "3693", "3783"})) << "a rise without bands: make-up";
}

TEST_F(SharedSets, OneSpectrumOfLuIsDarkEverywhere) {
    const auto names = found(spectra("issa_2025_sample.ti3"));
    EXPECT_EQ(names.size(), 2U);
    EXPECT_EQ(names.at("missing_values").size(), 10U);
    EXPECT_EQ(names.at("dark_everywhere").size(), 1U);
}

TEST_F(SharedSets, TheEyelidIsInOrderOnceItIsKnownAsATransmittance) {
    std::vector<Spectrum> eyelid = spectra("eyelid_transmittance_bierman_2011.txt");
    EXPECT_EQ(found(eyelid).begin()->first, "offset");
    eyelid.front().quantity = Quantity::transmittance;
    EXPECT_TRUE(found(eyelid).empty());
}

}  // namespace
}  // namespace skinfit
