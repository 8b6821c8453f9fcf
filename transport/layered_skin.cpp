#include "transport/layered_skin.hpp"

#include <cmath>

#include "model/chromophores.hpp"

namespace skinfit {
double ScatteringLaw::reduced_per_cm(double wavelength_nm) const {
    return at_500_nm_per_cm * std::pow(wavelength_nm / 500.0, -power);
}

TissueExtinction TissueExtinction::at(double wavelength_nm, const BilirubinBand& band) {
    const Extinction here = Extinction::at(wavelength_nm, Edition::revised);
    const Extinction shifted = Extinction::at(wavelength_nm - band.shift_nm, Edition::revised);
    return {.baseline_per_cm = here.baseline_per_cm,
            .melanosome_per_cm = 6.6e11 * std::pow(wavelength_nm, -3.33),
            .oxyhemoglobin = here.oxyhemoglobin,
            .deoxyhemoglobin = here.deoxyhemoglobin,
            .bilirubin = band.factor * shifted.bilirubin};
}

PerTurbidLayer layer_absorption_per_cm(const LayeredSkin& skin, const TissueExtinction& extinction) {
    const double blood = skin.hemoglobin_g_per_l * (skin.oxygen_saturation * extinction.oxyhemoglobin +
                                                    (1.0 - skin.oxygen_saturation) * extinction.deoxyhemoglobin);
    const double baseline = extinction.baseline_per_cm;
    const auto beside = [](double fraction, double pigment, double tissue) {
        return fraction * pigment + (1.0 - fraction) * tissue;
    };
    const double dermis = baseline + extinction.bilirubin * skin.dermal_bilirubin_g_per_l;
    return {baseline, beside(skin.melanosome_fraction, extinction.melanosome_per_cm, baseline),
            beside(skin.papillary_blood_fraction, blood, dermis), beside(skin.reticular_blood_fraction, blood, dermis),
            beside(skin.subcutis_blood_fraction, blood, baseline)};
}

TurbidStack turbid_stack(const LayeredSkin& skin, double wavelength_nm) {
    const auto layer = [&](const ScatteringLaw& law, double index, double thickness_cm) {
        return TurbidLayer{.scattering_per_cm = law.reduced_per_cm(wavelength_nm) / (1.0 - skin.anisotropy),
                           .anisotropy = skin.anisotropy,
                           .refractive_index = index,
                           .thickness_cm = thickness_cm};
    };
    return {.layers = {layer(skin.scattering, skin.stratum_corneum_refractive_index, skin.stratum_corneum_thickness_cm),
                       layer(skin.scattering, skin.epidermis_refractive_index, skin.epidermis_thickness_cm),
                       layer(skin.scattering, skin.dermis_refractive_index, skin.papillary_dermis_thickness_cm),
                       layer(skin.scattering, skin.dermis_refractive_index, skin.reticular_dermis_thickness_cm),
                       layer(skin.subcutis_scattering, skin.subcutis_refractive_index, skin.subcutis_thickness_cm)},
            .index_above = 1.0,
            .index_below = skin.subcutis_refractive_index};
}

}  // namespace skinfit
