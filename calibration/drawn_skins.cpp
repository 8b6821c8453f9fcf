#include "calibration/drawn_skins.hpp"

#include <cmath>
#include <numbers>

#include "fit/tissue.hpp"
#include "model/random.hpp"

namespace skinfit {
namespace {

double between(double low, double high, double xi) {
    return low + (high - low) * xi;
}

double log_between(double low, double high, double xi) {
    return low * std::pow(high / low, xi);
}

/// `dermal_hemoglobin_umol_per_l` where the two layers of the dermis hold these fractions of blood.
double dermal_hemoglobin(const LayeredSkin& layered, double papillary, double reticular) {
    Skin skin;
    skin.papillary_dermis_thickness_cm = layered.papillary_dermis_thickness_cm;
    skin.reticular_dermis_thickness_cm = layered.reticular_dermis_thickness_cm;
    skin.hemoglobin_g_per_l = layered.hemoglobin_g_per_l;
    skin.papillary_blood_fraction = papillary;
    skin.reticular_blood_fraction = reticular;
    return find_tissue_quantity("dermal_hemoglobin_umol_per_l")->value(skin);
}

LayeredSkin drawn_layers(const RandomRay& random) {
    const FourUniforms first = random.uniforms(0, 0);
    const FourUniforms second = random.uniforms(0, 1);
    LayeredSkin skin;
    skin.stratum_corneum_thickness_cm = log_between(0.001, 0.003, first[0]);
    skin.stratum_corneum_refractive_index = between(1.4, 1.55, first[1]);
    skin.epidermis_thickness_cm = log_between(0.003, 0.012, first[2]);
    skin.papillary_dermis_thickness_cm = log_between(0.01, 0.04, first[3]);
    skin.subcutis_scattering.at_500_nm_per_cm = log_between(12, 25, second[0]);
    return skin;
}

LayeredSkin drawn_skin(LayeredSkin skin, const RandomRay& random) {
    constexpr double spread = 0.4;
    const FourUniforms first = random.uniforms(0, 0);
    const FourUniforms second = random.uniforms(0, 1);
    const FourUniforms third = random.uniforms(0, 2);
    skin.scattering = {log_between(30, 130, first[0]), between(0.3, 1.8, first[1])};
    skin.melanosome_fraction = log_between(0.005, 0.4, first[2]);
    const double ratio =
        std::exp(spread * std::sqrt(-2.0 * std::log(second[0])) * std::cos(2.0 * std::numbers::pi * second[1]));
    const double evenly = dermal_hemoglobin(skin, 1.0, 1.0);
    skin.reticular_blood_fraction = log_between(0.003, 0.15, first[3]) * evenly / dermal_hemoglobin(skin, ratio, 1.0);
    skin.papillary_blood_fraction = ratio * skin.reticular_blood_fraction;
    skin.oxygen_saturation = between(0.2, 0.98, second[2]);
    skin.dermal_bilirubin_g_per_l = second[3] < 1.0 / 3.0 ? 0.0 : log_between(0.002, 0.3, third[0]);
    return skin;
}

}  // namespace

std::vector<DrawnFamily> drawn_families(std::uint64_t families, std::uint64_t each, std::uint64_t seed) {
    std::vector<DrawnFamily> drawn;
    for (std::uint64_t f = 0; f < families; ++f) {
        const LayeredSkin layers = drawn_layers(RandomRay(seed, f));
        DrawnFamily family{.bilirubin = f % 2 == 0 ? BilirubinBand() : BilirubinBand{.shift_nm = 0.0, .factor = 1.0},
                           .skins = {}};
        for (std::uint64_t i = 0; i < each; ++i) {
            family.skins.push_back(drawn_skin(layers, RandomRay(seed + 1, f * each + i)));
        }
        drawn.push_back(std::move(family));
    }
    return drawn;
}

double dermal_hemoglobin_umol_per_l(const LayeredSkin& skin) {
    return dermal_hemoglobin(skin, skin.papillary_blood_fraction, skin.reticular_blood_fraction);
}

}  // namespace skinfit
