#include "model/chromophores.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/input_error.hpp"
#include "model/table.hpp"

namespace skinfit {
namespace {

TEST(Chromophores, SpotValueByHand) {
    // 540 nm, Table 1, printed edition; plain arithmetic with the two measured points around 540 nm where needed.
    const double baseline = 0.244 + 85.3 * std::exp(-386 / 66.2);
    const double eumelanin = 6.995 + (5.758 - 6.995) * (540 - 523.76) / (550.7 - 523.76);
    const double pheomelanin = 3.919 + (3.024 - 3.919) * (540 - 524.32) / (549.09 - 524.32);
    const double carotene = 1056.1 / 537;
    const double blood =
        53236.0 / 66500 * 150 * 0.75 + 46592.0 / 66500 * 150 * 0.25 + carotene * 7e-5 + 65.8 / 585 * 0.05;
    const PerLayer<double> absorption = absorption_per_cm({}, Extinction::at(540, Edition::printed));
    EXPECT_DOUBLE_EQ(absorption[0], baseline + carotene * 2.1e-4);
    EXPECT_DOUBLE_EQ(absorption[1],
                     (eumelanin * 80 + pheomelanin * 12) * 0.052 + (baseline + carotene * 2.1e-4) * 0.948);
    EXPECT_DOUBLE_EQ(absorption[2], blood * 0.012 + baseline * 0.988);
    EXPECT_DOUBLE_EQ(absorption[3], blood * 0.0091 + baseline * 0.9909);
    const PerLayer<double> depth = optical_depth({}, Extinction::at(540, Edition::printed));
    EXPECT_DOUBLE_EQ(depth[0], absorption[0] * 0.001);
    EXPECT_DOUBLE_EQ(depth[1], absorption[1] * 0.01);
    EXPECT_DOUBLE_EQ(depth[2], absorption[2] * 0.02);
    EXPECT_DOUBLE_EQ(depth[3], absorption[3] * 0.18);
}

TEST(Chromophores, EditionsDifferByLn10InDecadicExtinctionsAlone) {
    for (const double wavelength_nm : {360.0, 451.3, 540.0, 699.0, 760.0}) {
        const Extinction printed = Extinction::at(wavelength_nm, Edition::printed);
        const Extinction revised = Extinction::at(wavelength_nm, Edition::revised);
        EXPECT_DOUBLE_EQ(revised.oxyhemoglobin, std::numbers::ln10 * printed.oxyhemoglobin);
        EXPECT_DOUBLE_EQ(revised.deoxyhemoglobin, std::numbers::ln10 * printed.deoxyhemoglobin);
        EXPECT_DOUBLE_EQ(revised.bilirubin, std::numbers::ln10 * printed.bilirubin);
        EXPECT_DOUBLE_EQ(revised.carotene, std::numbers::ln10 * printed.carotene);
        EXPECT_EQ(revised.eumelanin, printed.eumelanin);
        EXPECT_EQ(revised.pheomelanin, printed.pheomelanin);
        EXPECT_EQ(revised.baseline_per_cm, printed.baseline_per_cm);
    }
}

TEST(Chromophores, RangeIsWhereAllTablesAnswer) {
    const WavelengthRange range = modelled_wavelengths();
    EXPECT_EQ(range.lowest_nm, 250.0);
    EXPECT_EQ(range.highest_nm, 820.26);
    EXPECT_NO_THROW((void)Extinction::at(range.lowest_nm, Edition::revised));
    EXPECT_NO_THROW((void)Extinction::at(range.highest_nm, Edition::revised));
    EXPECT_THROW((void)Extinction::at(range.lowest_nm - 0.01, Edition::revised), InputError);
    EXPECT_THROW((void)Extinction::at(range.highest_nm + 0.01, Edition::revised), InputError);
    try {
        (void)Extinction::at(830, Edition::revised);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "wavelength 830 nm: outside the tables (the pigments are tabulated from 250 to 820.26 nm); choose "
                     "wavelengths inside that range");
    }
    EXPECT_GT(Extinction::at(700, Edition::revised).bilirubin, 0.0);
    EXPECT_EQ(Extinction::at(700.01, Edition::revised).bilirubin, 0.0);
    EXPECT_EQ(Extinction::at(700.01, Edition::revised).carotene, 0.0);
}

TEST(Chromophores, SkinWithoutPigmentsIsTheBaseline) {
    Skin skin;
    skin.melanosome_fraction = 0;
    skin.papillary_blood_fraction = 0;
    skin.reticular_blood_fraction = 0;
    skin.stratum_corneum_carotene_g_per_l = 0;
    skin.epidermis_carotene_g_per_l = 0;
    const Extinction extinction = Extinction::at(540, Edition::revised);
    const double b = extinction.baseline_per_cm;
    EXPECT_EQ(absorption_per_cm(skin, extinction), (PerLayer<double>{b, b, b, b}));
}

TEST(Chromophores, LayerOfPurePigmentIsThePigment) {
    Skin skin;
    skin.melanosome_fraction = 1;
    skin.papillary_blood_fraction = 1;
    skin.reticular_blood_fraction = 1;
    skin.bilirubin_g_per_l = 0;
    skin.dermis_carotene_g_per_l = 0;
    const Extinction extinction = Extinction::at(540, Edition::revised);
    skin.oxygen_saturation = 1;
    PerLayer<double> absorption = absorption_per_cm(skin, extinction);
    EXPECT_DOUBLE_EQ(absorption[1], 80 * extinction.eumelanin + 12 * extinction.pheomelanin);
    EXPECT_DOUBLE_EQ(absorption[2], 150 * extinction.oxyhemoglobin);
    skin.oxygen_saturation = 0;
    absorption = absorption_per_cm(skin, extinction);
    EXPECT_DOUBLE_EQ(absorption[2], 150 * extinction.deoxyhemoglobin);
    EXPECT_DOUBLE_EQ(absorption[3], 150 * extinction.deoxyhemoglobin);
}

TEST(Chromophores, WhatThePaperLacksEntersAsItSays) {
    const Extinction extinction = Extinction::at(460, Edition::revised);
    const PerLayer<double> plain = absorption_per_cm({}, extinction);
    Skin skin;
    skin.dermal_bilirubin_g_per_l = 0.2;
    skin.lateral_loss_per_cm = 0.4;
    const PerLayer<double> more = absorption_per_cm(skin, extinction);
    EXPECT_EQ(more[0], plain[0]);
    EXPECT_EQ(more[1], plain[1]);
    EXPECT_DOUBLE_EQ(more[2], plain[2] + 0.2 * extinction.bilirubin * (1 - skin.papillary_blood_fraction) + 0.4);
    EXPECT_DOUBLE_EQ(more[3], plain[3] + 0.2 * extinction.bilirubin * (1 - skin.reticular_blood_fraction) + 0.4);
}

/// 150 g/L of hemoglobin in blood of 45 % hematocrit absorb what the table says of it, in the reading of each edition.
TEST(Chromophores, WholeBloodIsThatOfItsTable) {
    const Table& table = embedded_table("whole_blood");
    const Curve oxygenated(table, "oxygenated");
    const Curve deoxygenated(table, "deoxygenated");
    Skin skin;
    skin.papillary_blood_fraction = 1;
    skin.bilirubin_g_per_l = 0;
    skin.dermis_carotene_g_per_l = 0;
    skin.whole_blood_share = 1;
    for (const double wavelength_nm : {420.0, 545.0, 700.0}) {
        const Extinction revised = Extinction::at(wavelength_nm, Edition::revised);
        skin.oxygen_saturation = 1;
        EXPECT_DOUBLE_EQ(absorption_per_cm(skin, revised)[2], 10 * oxygenated(wavelength_nm));
        skin.oxygen_saturation = 0;
        EXPECT_DOUBLE_EQ(absorption_per_cm(skin, revised)[2], 10 * deoxygenated(wavelength_nm));
        const Extinction printed = Extinction::at(wavelength_nm, Edition::printed);
        EXPECT_NEAR(absorption_per_cm(skin, printed)[2], 10 * deoxygenated(wavelength_nm) / std::log(10.0), 1e-12);
    }
}

TEST(MelaninSlope, IsAPowerOfTheWavelengthAbout500Nm) {
    for (const double wavelength_nm : {400.0, 500.0, 650.0}) {
        const Extinction extinction = Extinction::at(wavelength_nm, Edition::revised);
        const double melanin = 80 * extinction.eumelanin + 12 * extinction.pheomelanin;
        const double plain = absorption_per_cm({}, extinction)[1];
        for (const double slope : {-0.5, 1.2}) {
            Skin skin;
            skin.melanin_slope = slope;
            const double factor = std::pow(wavelength_nm / 500, -slope);
            EXPECT_NEAR(absorption_per_cm(skin, extinction)[1], plain + 0.052 * melanin * (factor - 1), 1e-13 * plain);
            // d factor / d slope = -ln(wavelength / 500 nm) factor
            const PerLayer<double> by = optical_depth_derivative(skin, extinction, Parameter::melanin_slope);
            const double expected = -std::log(wavelength_nm / 500) * factor * melanin * 0.052 * 0.01;
            EXPECT_NEAR(by[1], expected, 1e-13 * plain);
            EXPECT_EQ(by[0], 0.0);
            EXPECT_EQ(by[2], 0.0);
            EXPECT_EQ(by[3], 0.0);
        }
    }
}

/// Where a parameter is moved to: depths are linear in each, so any two values give the exact derivative.
struct Ends {
    double low;
    double high;
};

Ends ends_of(const ParameterInfo& row) {
    const bool fraction = row.name.ends_with("fraction") || row.name.ends_with("saturation");
    const double value = value_of(ParameterValues{}, row.parameter);
    return fraction || value == 0.0 ? Ends{0.0, 1.0} : Ends{0.0, 2.0 * value};
}

class DepthDerivative : public testing::TestWithParam<std::size_t> {};

TEST_P(DepthDerivative, IsTheSlopeBetweenAnyTwoValues) {
    const ParameterInfo& row = parameter_table()[GetParam()];
    if (row.parameter == Parameter::melanin_slope) GTEST_SKIP() << "no straight line: see MelaninSlope";
    const Ends ends = ends_of(row);
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        for (const double wavelength_nm : {420.0, 540.0, 660.0, 800.0}) {
            const Extinction extinction = Extinction::at(wavelength_nm, edition);
            ParameterValues values;
            const PerLayer<double> derivative = optical_depth_derivative(values.skin, extinction, row.parameter);
            value_of(values, row.parameter) = ends.low;
            const PerLayer<double> low = optical_depth(values.skin, extinction);
            value_of(values, row.parameter) = ends.high;
            const PerLayer<double> high = optical_depth(values.skin, extinction);
            for (std::size_t layer = 0; layer < layer_count; ++layer) {
                const double width = ends.high - ends.low;
                // At most 16 roundings of terms whose absolute values sum to at most low + high.
                const double bound = 16 * std::numeric_limits<double>::epsilon() * (low[layer] + high[layer]) / width;
                EXPECT_NEAR(derivative[layer], (high[layer] - low[layer]) / width, bound) << layer << wavelength_nm;
                if (low[layer] == high[layer]) {
                    EXPECT_EQ(derivative[layer], 0.0);
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, DepthDerivative, testing::Range<std::size_t>(0, parameter_count),
                         [](const auto& test) { return std::string(parameter_table()[test.param].name); });

}  // namespace
}  // namespace skinfit
