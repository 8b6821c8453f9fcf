#include "fit/inspection.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "fit/spectra_plot.hpp"
#include "fit/terminal_plot.hpp"

namespace skinfit {
namespace {

/// `count` spectra of 1, 2, 3 ... hundredths at 400, 410 and 420 nm.
SpectrumFile constant_spectra(int count) {
    SpectrumFile file{.source = "made.csv", .format = "columns", .spectra = {}};
    for (int i = 1; i <= count; ++i) {
        Spectrum spectrum;
        spectrum.name = std::to_string(i);
        spectrum.wavelength_nm = {400, 410, 420};
        spectrum.value.assign(3, 0.01 * i);
        spectrum.unit_rule = "fraction: stated by a comment in the file";
        file.spectra.push_back(spectrum);
    }
    return file;
}

TEST(QuantileBands, HoldFiveToNinetyFivePercent) {
    const QuantileBand band = quantile_band(constant_spectra(101).spectra);
    EXPECT_EQ(band.wavelength_nm, (std::vector<double>{400, 410, 420}));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_DOUBLE_EQ(band.low[i], 0.06);
        EXPECT_DOUBLE_EQ(band.median[i], 0.51);
        EXPECT_DOUBLE_EQ(band.high[i], 0.96);
    }
}

TEST(QuantileBands, TakeEachSpectrumWhereItReaches) {
    std::vector<Spectrum> spectra = constant_spectra(2).spectra;
    spectra[1].wavelength_nm = {415, 425, 435};
    const QuantileBand band = quantile_band(spectra);
    EXPECT_EQ(band.wavelength_nm, (std::vector<double>{400, 410, 415, 420, 425, 435}));
    EXPECT_DOUBLE_EQ(band.high.front(), 0.01);
    EXPECT_DOUBLE_EQ(band.low[3], 0.01);
    EXPECT_DOUBLE_EQ(band.high[3], 0.02);
    EXPECT_DOUBLE_EQ(band.low.back(), 0.02);
}

TEST(TerminalPlots, DrawARisingLineFromCornerToCorner) {
    const std::string text = terminal_plot({{.x = {0, 1}, .y = {0, 1}}}, "nm");
    const std::string first_row = text.substr(0, text.find('\n'));
    EXPECT_TRUE(first_row.starts_with("       1 ┤⠀")) << text;
    EXPECT_TRUE(first_row.ends_with("⠋")) << text;
    EXPECT_NE(text.find("       0 ┤⣀"), std::string::npos) << text;
    EXPECT_EQ(std::ranges::count(text, '\n'), 14);
}

TEST(Inspections, LookForHemoglobinWhereThereIsADermis) {
    Spectrum grey;
    grey.name = "grey";
    for (int nm = 400; nm <= 700; nm += 10) {
        grey.wavelength_nm.push_back(nm);
        grey.value.push_back(0.4 + 1e-4 * nm);
    }
    const std::vector<Spectrum> spectra = {grey};
    Configuration configuration = default_configuration();
    const std::vector<Finding> of_skin = findings_before_fit(configuration, spectra);
    ASSERT_EQ(of_skin.size(), 1U);
    EXPECT_EQ(of_skin[0].name, "no_hemoglobin");
    configuration.layers = 2;
    EXPECT_TRUE(findings_before_fit(configuration, spectra).empty());
}

TEST(Inspections, TellWhatTheSpectraShare) {
    SpectrumFile file = constant_spectra(2);
    file.spectra[0].geometry.incidence_deg = 8;
    file.spectra[1].geometry.incidence_deg = 8;
    file.spectra[0].quantity = Quantity::reflectance;
    const Json json = inspection_json(inspected(file));
    EXPECT_EQ(json["spectra"], 2);
    EXPECT_EQ(json["names"], (Json{"1", "2"}));
    EXPECT_EQ(json["wavelength_nm"], (Json{{"first", 400.0}, {"last", 420.0}, {"step", 10.0}}));
    EXPECT_EQ(json["unit_rule"], "fraction: stated by a comment in the file");
    EXPECT_EQ(json["geometry"]["incidence_deg"], 8.0);
    EXPECT_EQ(json["geometry"]["specular"], Json());
    EXPECT_EQ(json["quantity"], Json()) << "only one of them states it";
}

TEST(Inspections, HaveNoStepWhereWavelengthsAreUneven) {
    SpectrumFile file = constant_spectra(1);
    file.spectra[0].wavelength_nm = {400, 410, 421};
    EXPECT_EQ(inspection_json(inspected(file))["wavelength_nm"]["step"], Json());
}

TEST(Inspections, ListEachKindOfFindingOnce) {
    SpectrumFile file = constant_spectra(20);
    for (Spectrum& spectrum : file.spectra) spectrum.value = {0.2, 0.3, -0.1};
    const Inspection inspection = inspected(file);
    const std::string text = inspection_text(inspection);
    EXPECT_NE(text.find("  WARNING outside_0_1: 20 of 20 spectra: 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 and 8 more\n"
                        "      1: 1 of 3 values lie outside 0 to 1, as -0.1 at 420 nm does\n"
                        "      remedy: correct the dark reading of the instrument, or leave those readings out\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("outside_0_1", text.find("outside_0_1") + 1), std::string::npos);
    EXPECT_EQ(findings_json(inspection.findings).size(), 80U) << "with offset, spikes and duplicate";
}

}  // namespace
}  // namespace skinfit
