#include "model/parameters.hpp"

#include <algorithm>
#include <cassert>
#include <variant>

namespace skinfit {
namespace {

struct ParameterRow {
    ParameterInfo info;
    std::variant<double Skin::*, double Instrument::*> field;
};

constexpr std::string_view table1 = "[KA04, Table 1]; bounds: chosen";
constexpr std::string_view whole_range = "[KA04, Table 1]; bounds: all there is";
constexpr std::string_view blood_source = "[KA04, Table 1]; bounds: chosen, far above its 0.002-0.07 (Sec. 2.1)";

const std::array<ParameterRow, parameter_count> rows = {{
    // parameter, name, unit, lowest, highest, lower, upper, steers, meaning, source
    {{Parameter::melanosome_fraction, "melanosome_fraction", "", 0, 1, 0, 0.5, false,
      "volume fraction of melanosomes in the epidermis",
      "[KA04, Table 1]; bounds: chosen, around its 0.013-0.43 (Sec. 2.1)"},
     &Skin::melanosome_fraction},
    {{Parameter::eumelanin_g_per_l, "eumelanin_g_per_l", "g/L", 0, 1000, 33, 245, false, "eumelanin in a melanosome",
      "[KA04, Table 1]; bounds: its pheomelanin/eumelanin ratio of 0.049-0.36 (Sec. 2.1) at 12 g/L pheomelanin"},
     &Skin::eumelanin_g_per_l},
    {{Parameter::pheomelanin_g_per_l, "pheomelanin_g_per_l", "g/L", 0, 1000, 3.9, 28.8, false,
      "pheomelanin in a melanosome",
      "[KA04, Table 1]; bounds: its pheomelanin/eumelanin ratio of 0.049-0.36 (Sec. 2.1) at 80 g/L eumelanin"},
     &Skin::pheomelanin_g_per_l},
    {{Parameter::melanin_slope, "melanin_slope", "", -10, 10, -2, 4, false,
      "both melanins absorb times (wavelength / 500 nm)^-slope",
      "0: [KA04]; skinfit: readings of contact spheres ask for about 1.2; bounds: chosen"},
     &Skin::melanin_slope},
    {{Parameter::papillary_blood_fraction, "papillary_blood_fraction", "", 0, 1, 0, 0.3, false,
      "volume fraction of blood in the papillary dermis", blood_source},
     &Skin::papillary_blood_fraction},
    {{Parameter::reticular_blood_fraction, "reticular_blood_fraction", "", 0, 1, 0, 0.3, false,
      "volume fraction of blood in the reticular dermis", blood_source},
     &Skin::reticular_blood_fraction},
    {{Parameter::oxygen_saturation, "oxygen_saturation", "", 0, 1, 0, 1, false, "oxyhemoglobin share of the hemoglobin",
      whole_range},
     &Skin::oxygen_saturation},
    {{Parameter::hemoglobin_g_per_l, "hemoglobin_g_per_l", "g/L", 0, 400, 134, 173, false, "hemoglobin in whole blood",
      "[KA04, Table 1]; bounds: its 134-173 (Sec. 2.1)"},
     &Skin::hemoglobin_g_per_l},
    {{Parameter::whole_blood_share, "whole_blood_share", "", 0, 1, 0, 1, false,
      "share of [BOSSCHAART14]'s whole blood in the hemoglobin spectra; the rest is [PRAHL98]'s solutions",
      "0: [KA04]; skinfit: readings of real skin are closest half way between them"},
     &Skin::whole_blood_share},
    {{Parameter::bilirubin_g_per_l, "bilirubin_g_per_l", "g/L", 0, 30, 0, 3, false,
      "bilirubin in whole blood; 1 mg/dL is 0.01 g/L", "[KA04, Table 1]; bounds: up to its Fig. 9"},
     &Skin::bilirubin_g_per_l},
    {{Parameter::dermal_bilirubin_g_per_l, "dermal_bilirubin_g_per_l", "g/L", 0, 30, 0, 1, false,
      "bilirubin in the dermis outside its blood; 1 mg/dL is 0.01 g/L",
      "0: [KA04]; most of the skin's bilirubin lies there [BOSSCHAART12]; bounds: chosen"},
     &Skin::dermal_bilirubin_g_per_l},
    {{Parameter::stratum_corneum_carotene_g_per_l, "stratum_corneum_carotene_g_per_l", "g/L", 0, 1, 0, 1e-2, false,
      "beta-carotene in the stratum corneum", table1},
     &Skin::stratum_corneum_carotene_g_per_l},
    {{Parameter::epidermis_carotene_g_per_l, "epidermis_carotene_g_per_l", "g/L", 0, 1, 0, 1e-2, false,
      "beta-carotene in the epidermis", table1},
     &Skin::epidermis_carotene_g_per_l},
    {{Parameter::dermis_carotene_g_per_l, "dermis_carotene_g_per_l", "g/L", 0, 1, 0, 1e-2, false,
      "beta-carotene in the blood of the dermis", table1},
     &Skin::dermis_carotene_g_per_l},
    {{Parameter::lateral_loss_per_cm, "lateral_loss_per_cm", "1/cm", 0, 100, 0, 3, false,
      "absorbs in the dermis, alike at all wavelengths: light that leaves beside the port is lost in proportion to its "
      "path",
      "0: [KA04]; skinfit: readings through 3 mm ask for about 0.4, of spheres for 0.03; bounds: chosen"},
     &Skin::lateral_loss_per_cm},
    {{Parameter::stratum_corneum_thickness_cm, "stratum_corneum_thickness_cm", "cm", 1e-5, 1, 0.001, 0.004, false,
      "thickness of the stratum corneum",
      "[KA04, Table 1]; bounds: chosen, above its 0.001-0.002 (Sec. 2.1) and 0.0023 (Fig. 4)"},
     &Skin::stratum_corneum_thickness_cm},
    {{Parameter::epidermis_thickness_cm, "epidermis_thickness_cm", "cm", 1e-5, 1, 0.0027, 0.015, false,
      "thickness of the living epidermis", "[KA04, Table 1]; bounds: its 0.0027-0.015 (Sec. 2.1)"},
     &Skin::epidermis_thickness_cm},
    {{Parameter::papillary_dermis_thickness_cm, "papillary_dermis_thickness_cm", "cm", 1e-5, 10, 0.005, 0.05, true,
      "thickness of the papillary dermis",
      "[KA04, Table 1]; bounds: chosen, within its 0.06-0.3 cm for the whole dermis (Sec. 2.1)"},
     &Skin::papillary_dermis_thickness_cm},
    {{Parameter::reticular_dermis_thickness_cm, "reticular_dermis_thickness_cm", "cm", 1e-5, 10, 0.05, 0.3, true,
      "thickness of the reticular dermis",
      "[KA04, Table 1]; bounds: chosen, within its 0.06-0.3 cm for the whole dermis (Sec. 2.1)"},
     &Skin::reticular_dermis_thickness_cm},
    {{Parameter::stratum_corneum_refractive_index, "stratum_corneum_refractive_index", "", 1, 2, 1.3, 1.6, true,
      "refractive index of the stratum corneum", table1},
     &Skin::stratum_corneum_refractive_index},
    {{Parameter::epidermis_refractive_index, "epidermis_refractive_index", "", 1, 2, 1.3, 1.6, true,
      "refractive index of the epidermis", table1},
     &Skin::epidermis_refractive_index},
    {{Parameter::papillary_dermis_refractive_index, "papillary_dermis_refractive_index", "", 1, 2, 1.3, 1.6, true,
      "refractive index of the papillary dermis", table1},
     &Skin::papillary_dermis_refractive_index},
    {{Parameter::reticular_dermis_refractive_index, "reticular_dermis_refractive_index", "", 1, 2, 1.3, 1.6, true,
      "refractive index of the reticular dermis", table1},
     &Skin::reticular_dermis_refractive_index},
    {{Parameter::fibre_refractive_index, "fibre_refractive_index", "", 1, 2, 1.4, 1.6, true,
      "refractive index of the collagen fibres", table1},
     &Skin::fibre_refractive_index},
    {{Parameter::fibril_radius_nm, "fibril_radius_nm", "nm", 1, 100, 10, 60, true, "radius of the collagen fibrils",
      table1},
     &Skin::fibril_radius_nm},
    {{Parameter::fold_aspect_ratio, "fold_aspect_ratio", "", 0.001, 1, 0.001, 1, true,
      "aspect ratio of the surface folds; steers surface-reflected rays only", whole_range},
     &Skin::fold_aspect_ratio},
    {{Parameter::scale, "scale", "", 0.01, 100, 0.5, 2, false, "measured = scale * modelled + offset",
      "skinfit: fits of 45/0 readings ask for about 1.1, contact instruments lose about 10 %"},
     &Instrument::scale},
    {{Parameter::offset, "offset", "", -1, 1, -0.1, 0.1, false, "measured = scale * modelled + offset",
      "skinfit: stray light and dark level"},
     &Instrument::offset},
    {{Parameter::specular_fraction, "specular_fraction", "", 0, 1, 0, 1, false,
      "share of the surface reflectance still seen where specular is excluded",
      "skinfit: 0 for 45/0 and for an ideal gloss trap"},
     &Instrument::specular_fraction},
    {{Parameter::wavelength_shift_nm, "wavelength_shift_nm", "nm", -20, 20, -5, 5, true,
      "the model is evaluated at the stated wavelength plus this",
      "skinfit: wavelength accuracy of small spectrophotometers"},
     &Instrument::wavelength_shift_nm},
}};

const ParameterRow& row(Parameter parameter) {
    const ParameterRow& found = rows[static_cast<std::size_t>(parameter)];
    assert(found.info.parameter == parameter);
    return found;
}

}  // namespace

std::span<const ParameterInfo, parameter_count> parameter_table() {
    static const std::array<ParameterInfo, parameter_count> table = [] {
        std::array<ParameterInfo, parameter_count> infos;
        std::ranges::transform(rows, infos.begin(), &ParameterRow::info);
        return infos;
    }();
    return table;
}

const ParameterInfo& info(Parameter parameter) {
    return row(parameter).info;
}

bool may_be_absent(Parameter parameter) {
    constexpr std::array amounts = {Parameter::melanosome_fraction,
                                    Parameter::eumelanin_g_per_l,
                                    Parameter::pheomelanin_g_per_l,
                                    Parameter::papillary_blood_fraction,
                                    Parameter::reticular_blood_fraction,
                                    Parameter::hemoglobin_g_per_l,
                                    Parameter::bilirubin_g_per_l,
                                    Parameter::dermal_bilirubin_g_per_l,
                                    Parameter::stratum_corneum_carotene_g_per_l,
                                    Parameter::epidermis_carotene_g_per_l,
                                    Parameter::dermis_carotene_g_per_l,
                                    Parameter::lateral_loss_per_cm,
                                    Parameter::specular_fraction};
    return std::ranges::find(amounts, parameter) != amounts.end();
}

bool belongs_to_instrument(Parameter parameter) {
    return std::holds_alternative<double Instrument::*>(row(parameter).field);
}

std::optional<Parameter> find_parameter(std::string_view name) {
    const auto found = std::ranges::find(rows, name, [](const ParameterRow& row) { return row.info.name; });
    if (found == rows.end()) return std::nullopt;
    return found->info.parameter;
}

double& value_of(ParameterValues& values, Parameter parameter) {
    const auto& field = row(parameter).field;
    if (const auto* skin = std::get_if<double Skin::*>(&field)) return values.skin.**skin;
    return values.instrument.*std::get<double Instrument::*>(field);
}

double value_of(const ParameterValues& values, Parameter parameter) {
    ParameterValues copy = values;
    return value_of(copy, parameter);
}

}  // namespace skinfit
