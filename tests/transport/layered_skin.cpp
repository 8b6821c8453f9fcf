#include "transport/layered_skin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/input_error.hpp"
#include "model/chromophores.hpp"
#include "model/fresnel.hpp"

namespace skinfit {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double of(const PerTurbidLayer& values, SkinLayer layer) {
    return values[static_cast<std::size_t>(layer)];
}

TEST(LayeredSkin, AbsorbsByTheWordsOfTheField) {
    const double wavelength_nm = 540;
    const TissueExtinction tissue = TissueExtinction::at(wavelength_nm);
    const Extinction model = Extinction::at(wavelength_nm, Edition::revised);
    EXPECT_EQ(tissue.baseline_per_cm, model.baseline_per_cm);
    EXPECT_EQ(tissue.oxyhemoglobin, model.oxyhemoglobin);
    EXPECT_EQ(tissue.deoxyhemoglobin, model.deoxyhemoglobin);
    EXPECT_DOUBLE_EQ(tissue.melanosome_per_cm, 6.6e11 / std::pow(wavelength_nm, 3.33));

    LayeredSkin skin;
    skin.melanosome_fraction = 0.0;
    skin.papillary_blood_fraction = skin.reticular_blood_fraction = skin.subcutis_blood_fraction = 0.0;
    for (std::size_t layer = 0; layer < skin_layer_count; ++layer) {
        EXPECT_EQ(layer_absorption_per_cm(skin, tissue)[layer], tissue.baseline_per_cm);
    }
    skin.melanosome_fraction = skin.papillary_blood_fraction = 1.0;
    skin.oxygen_saturation = 1.0;
    const PerTurbidLayer full = layer_absorption_per_cm(skin, tissue);
    EXPECT_EQ(of(full, SkinLayer::epidermis), tissue.melanosome_per_cm);
    EXPECT_DOUBLE_EQ(of(full, SkinLayer::papillary_dermis), 150.0 * tissue.oxyhemoglobin);
    EXPECT_EQ(of(full, SkinLayer::reticular_dermis), tissue.baseline_per_cm);
    skin.oxygen_saturation = 0.0;
    EXPECT_DOUBLE_EQ(of(layer_absorption_per_cm(skin, tissue), SkinLayer::papillary_dermis),
                     150.0 * tissue.deoxyhemoglobin);
}

TEST(LayeredSkin, BilirubinIsInTheDermisOutsideVessels) {
    const TissueExtinction tissue = TissueExtinction::at(470);
    LayeredSkin skin;
    const PerTurbidLayer without = layer_absorption_per_cm(skin, tissue);
    skin.dermal_bilirubin_g_per_l = 0.1;
    const PerTurbidLayer with = layer_absorption_per_cm(skin, tissue);
    // Differences of sums below 20 per cm.
    EXPECT_NEAR(with[2] - without[2], (1 - skin.papillary_blood_fraction) * 0.1 * tissue.bilirubin, 64 * epsilon);
    EXPECT_NEAR(with[3] - without[3], (1 - skin.reticular_blood_fraction) * 0.1 * tissue.bilirubin, 64 * epsilon);
    EXPECT_EQ(with[0], without[0]);
    EXPECT_EQ(with[1], without[1]);
    EXPECT_EQ(with[4], without[4]);
    EXPECT_EQ(TissueExtinction::at(470, {0.0, 1.0}).bilirubin, Extinction::at(470, Edition::revised).bilirubin);
    // Its band lies where albumin has put it.
    EXPECT_GT(TissueExtinction::at(460).bilirubin, TissueExtinction::at(451).bilirubin);
    EXPECT_LT(Extinction::at(460, Edition::revised).bilirubin, Extinction::at(451, Edition::revised).bilirubin);
}

TEST(LayeredSkin, ScattersByAPowerOfTheWavelength) {
    const LayeredSkin skin;
    const TurbidStack at_500 = turbid_stack(skin, 500);
    const TurbidStack at_700 = turbid_stack(skin, 700);
    ASSERT_EQ(at_500.layers.size(), skin_layer_count);
    for (const TurbidLayer& layer : at_500.layers) EXPECT_EQ(layer.anisotropy, skin.anisotropy);
    EXPECT_DOUBLE_EQ(at_500.layers[3].scattering_per_cm * (1 - skin.anisotropy), 46.0);
    EXPECT_DOUBLE_EQ(at_500.layers[4].scattering_per_cm * (1 - skin.anisotropy), 18.4);
    EXPECT_DOUBLE_EQ(at_700.layers[1].scattering_per_cm, at_500.layers[1].scattering_per_cm * std::pow(1.4, -1.421));
    EXPECT_EQ(at_500.index_below, at_500.layers[4].refractive_index) << "light is reflected below the skin";
}

TEST(LayeredSkin, IsRefusedOutsideTheTables) {
    EXPECT_THROW((void)TissueExtinction::at(200), InputError);
    EXPECT_THROW((void)TissueExtinction::at(1200), InputError);
}

}  // namespace
}  // namespace skinfit
