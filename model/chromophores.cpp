#include "model/chromophores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/input_error.hpp"
#include "model/table.hpp"

namespace skinfit {
namespace {

// [KA04, Eqs. 6-12]
constexpr double hemoglobin_g_per_mol = 66500;
/// At a hematocrit of 45 %. [BOSSCHAART14]
constexpr double hemoglobin_of_whole_blood_g_per_l = 150;
constexpr double bilirubin_g_per_mol = 585;
constexpr double carotene_g_per_mol = 537;

/// [JACQUES98]; the paper names a baseline without a formula, the authors' code uses this one. (open in [KA04])
double baseline_per_cm(double wavelength_nm) {
    return 0.244 + 85.3 * std::exp(-(wavelength_nm - 154.0) / 66.2);
}

double oxyhemoglobin(const Skin& skin, const Extinction& extinction) {
    return std::lerp(extinction.oxyhemoglobin, extinction.oxygenated_blood, skin.whole_blood_share);
}

double deoxyhemoglobin(const Skin& skin, const Extinction& extinction) {
    return std::lerp(extinction.deoxyhemoglobin, extinction.deoxygenated_blood, skin.whole_blood_share);
}

/// Of 1 g/L. [KA04, Eqs. 11, 12]
double hemoglobin_mixture(const Skin& skin, const Extinction& extinction) {
    return oxyhemoglobin(skin, extinction) * skin.oxygen_saturation +
           deoxyhemoglobin(skin, extinction) * (1.0 - skin.oxygen_saturation);
}

double hemoglobin_per_cm(const Skin& skin, const Extinction& extinction) {
    return skin.hemoglobin_g_per_l * hemoglobin_mixture(skin, extinction);
}

double blood_per_cm(const Skin& skin, const Extinction& extinction) {
    return hemoglobin_per_cm(skin, extinction) + extinction.carotene * skin.dermis_carotene_g_per_l +
           extinction.bilirubin * skin.bilirubin_g_per_l;
}

/// Of both melanins; 1 at 500 nm.
double melanin_factor(const Skin& skin, const Extinction& extinction) {
    return std::exp(-skin.melanin_slope * extinction.log_wavelength);
}

double melanosome_per_cm(const Skin& skin, const Extinction& extinction) {
    return melanin_factor(skin, extinction) *
           (extinction.eumelanin * skin.eumelanin_g_per_l + extinction.pheomelanin * skin.pheomelanin_g_per_l);
}

/// The dermis outside its blood.
double dermis_ground_per_cm(const Skin& skin, const Extinction& extinction) {
    return extinction.baseline_per_cm + extinction.bilirubin * skin.dermal_bilirubin_g_per_l;
}

double epidermis_ground_per_cm(const Skin& skin, const Extinction& extinction) {
    return extinction.baseline_per_cm + extinction.carotene * skin.epidermis_carotene_g_per_l;
}

/// The derivative of each layer's absorption coefficient by `parameter`, per cm per unit of the parameter.
PerLayer<double> absorption_derivative(const Skin& skin, const Extinction& extinction, Parameter parameter) {
    const auto epidermal = [](double value) { return PerLayer<double>{0, value, 0, 0}; };
    const auto in_blood = [&skin](double value) {
        return PerLayer<double>{0, 0, value * skin.papillary_blood_fraction, value * skin.reticular_blood_fraction};
    };
    switch (parameter) {
        case Parameter::melanosome_fraction:
            return epidermal(melanosome_per_cm(skin, extinction) - epidermis_ground_per_cm(skin, extinction));
        case Parameter::eumelanin_g_per_l:
            return epidermal(melanin_factor(skin, extinction) * extinction.eumelanin * skin.melanosome_fraction);
        case Parameter::pheomelanin_g_per_l:
            return epidermal(melanin_factor(skin, extinction) * extinction.pheomelanin * skin.melanosome_fraction);
        case Parameter::melanin_slope:
            return epidermal(-extinction.log_wavelength * melanosome_per_cm(skin, extinction) *
                             skin.melanosome_fraction);
        case Parameter::papillary_blood_fraction:
            return {0, 0, blood_per_cm(skin, extinction) - dermis_ground_per_cm(skin, extinction), 0};
        case Parameter::reticular_blood_fraction:
            return {0, 0, 0, blood_per_cm(skin, extinction) - dermis_ground_per_cm(skin, extinction)};
        case Parameter::oxygen_saturation:
            return in_blood(skin.hemoglobin_g_per_l *
                            (oxyhemoglobin(skin, extinction) - deoxyhemoglobin(skin, extinction)));
        case Parameter::hemoglobin_g_per_l:
            return in_blood(hemoglobin_mixture(skin, extinction));
        case Parameter::whole_blood_share:
            return in_blood(
                skin.hemoglobin_g_per_l *
                ((extinction.oxygenated_blood - extinction.oxyhemoglobin) * skin.oxygen_saturation +
                 (extinction.deoxygenated_blood - extinction.deoxyhemoglobin) * (1.0 - skin.oxygen_saturation)));
        case Parameter::bilirubin_g_per_l:
            return in_blood(extinction.bilirubin);
        case Parameter::dermal_bilirubin_g_per_l:
            return {0, 0, extinction.bilirubin * (1.0 - skin.papillary_blood_fraction),
                    extinction.bilirubin * (1.0 - skin.reticular_blood_fraction)};
        case Parameter::lateral_loss_per_cm:
            return {0, 0, 1, 1};
        case Parameter::stratum_corneum_carotene_g_per_l:
            return {extinction.carotene, 0, 0, 0};
        case Parameter::epidermis_carotene_g_per_l:
            return epidermal(extinction.carotene * (1.0 - skin.melanosome_fraction));
        case Parameter::dermis_carotene_g_per_l:
            return in_blood(extinction.carotene);
        default:
            return {};
    }
}

/// What one table knows is of no help: the model needs them all.
void require_modelled(double wavelength_nm) {
    static const WavelengthRange modelled = modelled_wavelengths();
    if (wavelength_nm >= modelled.lowest_nm && wavelength_nm <= modelled.highest_nm) return;
    throw InputError(
        {.where = fmt::format("wavelength {} nm", wavelength_nm),
         .problem = "outside the tables",
         .why = fmt::format("the pigments are tabulated from {} to {} nm", modelled.lowest_nm, modelled.highest_nm),
         .remedy = "choose wavelengths inside that range"});
}

}  // namespace

Extinction Extinction::at(double wavelength_nm, Edition edition) {
    require_modelled(wavelength_nm);
    static const Curve eumelanin(embedded_table("eumelanin"), "eumelanin");
    static const Curve pheomelanin(embedded_table("pheomelanin"), "pheomelanin");
    static const Curve oxyhemoglobin(embedded_table("hemoglobin"), "oxyhemoglobin");
    static const Curve deoxyhemoglobin(embedded_table("hemoglobin"), "deoxyhemoglobin");
    static const Curve oxygenated(embedded_table("whole_blood"), "oxygenated");
    static const Curve deoxygenated(embedded_table("whole_blood"), "deoxygenated");
    static const Curve bilirubin(embedded_table("bilirubin"), "bilirubin");
    static const Curve carotene(embedded_table("beta_carotene"), "beta_carotene");
    const double decadic = edition == Edition::revised ? std::numbers::ln10 : 1.0;
    // 10 mm in a cm; in the reading that the edition has of the hemoglobin of the paper.
    const double blood = 10.0 / hemoglobin_of_whole_blood_g_per_l * decadic / std::numbers::ln10;
    return {.baseline_per_cm = skinfit::baseline_per_cm(wavelength_nm),
            .eumelanin = eumelanin(wavelength_nm),
            .pheomelanin = pheomelanin(wavelength_nm),
            .oxyhemoglobin = decadic * oxyhemoglobin(wavelength_nm) / hemoglobin_g_per_mol,
            .deoxyhemoglobin = decadic * deoxyhemoglobin(wavelength_nm) / hemoglobin_g_per_mol,
            .oxygenated_blood = blood * oxygenated(wavelength_nm),
            .deoxygenated_blood = blood * deoxygenated(wavelength_nm),
            .bilirubin = decadic * bilirubin(wavelength_nm) / bilirubin_g_per_mol,
            .carotene = decadic * carotene(wavelength_nm) / carotene_g_per_mol,
            .log_wavelength = std::log(wavelength_nm / 500.0)};
}

WavelengthRange modelled_wavelengths() {
    WavelengthRange range{.lowest_nm = 0.0, .highest_nm = 1e9};
    for (const char* name : {"eumelanin", "pheomelanin", "hemoglobin", "bilirubin", "beta_carotene"}) {
        const Table& table = embedded_table(name);
        range.lowest_nm = std::max(range.lowest_nm, table.columns[0].front());
        if (table.above == OutsideRange::error) {
            range.highest_nm = std::min(range.highest_nm, table.columns[0].back());
        }
    }
    return range;
}

PerLayer<double> absorption_per_cm(const Skin& skin, const Extinction& extinction) {
    const double baseline = extinction.baseline_per_cm;
    const double blood = blood_per_cm(skin, extinction);
    const double ground = dermis_ground_per_cm(skin, extinction);
    const auto dermal = [&](double blood_fraction) {  // [KA04, Eq. 10]
        return blood * blood_fraction + ground * (1.0 - blood_fraction) + skin.lateral_loss_per_cm;
    };
    return {
        baseline + extinction.carotene * skin.stratum_corneum_carotene_g_per_l,  // [KA04, Eq. 6]
        melanosome_per_cm(skin, extinction) * skin.melanosome_fraction +
            epidermis_ground_per_cm(skin, extinction) * (1.0 - skin.melanosome_fraction),  // [KA04, Eqs. 7-9]
        dermal(skin.papillary_blood_fraction),
        dermal(skin.reticular_blood_fraction),
    };
}

PerLayer<double> optical_depth(const Skin& skin, const Extinction& extinction) {
    PerLayer<double> depth = absorption_per_cm(skin, extinction);
    const PerLayer<double> thickness = thickness_cm(skin);
    for (std::size_t layer = 0; layer < layer_count; ++layer) depth[layer] *= thickness[layer];
    return depth;
}

PerLayer<double> optical_depth_derivative(const Skin& skin, const Extinction& extinction, Parameter parameter) {
    if (parameter >= Parameter::stratum_corneum_thickness_cm && parameter <= Parameter::reticular_dermis_thickness_cm) {
        const auto layer =
            static_cast<std::size_t>(parameter) - static_cast<std::size_t>(Parameter::stratum_corneum_thickness_cm);
        PerLayer<double> by_thickness{};
        by_thickness[layer] = absorption_per_cm(skin, extinction)[layer];
        return by_thickness;
    }
    PerLayer<double> derivative = absorption_derivative(skin, extinction, parameter);
    const PerLayer<double> thickness = thickness_cm(skin);
    for (std::size_t layer = 0; layer < layer_count; ++layer) derivative[layer] *= thickness[layer];
    return derivative;
}

double pigment_derivative(const PerLayer<double>& by_optical_depth, const Skin& skin, const Extinction& extinction,
                          Parameter parameter) {
    const PerLayer<double> depth_by = optical_depth_derivative(skin, extinction, parameter);
    double by = 0.0;
    for (std::size_t layer = 0; layer < layer_count; ++layer) by += by_optical_depth[layer] * depth_by[layer];
    return by;
}

}  // namespace skinfit
