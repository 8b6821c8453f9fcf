#include "fit/derived.hpp"

namespace skinfit {
namespace {

constexpr std::array<DerivedInfo, derived_count> table = {{
    {"total_blood_fraction", "volume fraction of blood in the dermis, both layers weighted by their thickness"},
    {"pheomelanin_eumelanin_ratio", "pheomelanin_g_per_l / eumelanin_g_per_l"},
}};

double total_blood_slope(const Skin& skin, Parameter parameter) {
    const double dermis_cm = skin.papillary_dermis_thickness_cm + skin.reticular_dermis_thickness_cm;
    const double excess = skin.papillary_blood_fraction - skin.reticular_blood_fraction;
    switch (parameter) {
        case Parameter::papillary_blood_fraction:
            return skin.papillary_dermis_thickness_cm / dermis_cm;
        case Parameter::reticular_blood_fraction:
            return skin.reticular_dermis_thickness_cm / dermis_cm;
        case Parameter::papillary_dermis_thickness_cm:
            return excess * skin.reticular_dermis_thickness_cm / (dermis_cm * dermis_cm);
        case Parameter::reticular_dermis_thickness_cm:
            return -excess * skin.papillary_dermis_thickness_cm / (dermis_cm * dermis_cm);
        default:
            return 0.0;
    }
}

double ratio_slope(const Skin& skin, Parameter parameter) {
    switch (parameter) {
        case Parameter::pheomelanin_g_per_l:
            return 1.0 / skin.eumelanin_g_per_l;
        case Parameter::eumelanin_g_per_l:
            return -skin.pheomelanin_g_per_l / (skin.eumelanin_g_per_l * skin.eumelanin_g_per_l);
        default:
            return 0.0;
    }
}

}  // namespace

std::span<const DerivedInfo, derived_count> derived_table() {
    return table;
}

double derived_value(Derived quantity, const ParameterValues& values) {
    const Skin& skin = values.skin;
    if (quantity == Derived::pheomelanin_eumelanin_ratio) return skin.pheomelanin_g_per_l / skin.eumelanin_g_per_l;
    return (skin.papillary_blood_fraction * skin.papillary_dermis_thickness_cm +
            skin.reticular_blood_fraction * skin.reticular_dermis_thickness_cm) /
           (skin.papillary_dermis_thickness_cm + skin.reticular_dermis_thickness_cm);
}

bool depends_on(Derived quantity, Parameter parameter) {
    switch (parameter) {
        case Parameter::papillary_blood_fraction:
        case Parameter::reticular_blood_fraction:
        case Parameter::papillary_dermis_thickness_cm:
        case Parameter::reticular_dermis_thickness_cm:
            return quantity == Derived::total_blood_fraction;
        case Parameter::pheomelanin_g_per_l:
        case Parameter::eumelanin_g_per_l:
            return quantity == Derived::pheomelanin_eumelanin_ratio;
        default:
            return false;
    }
}

double derived_slope(Derived quantity, const ParameterValues& values, Parameter parameter) {
    return quantity == Derived::total_blood_fraction ? total_blood_slope(values.skin, parameter)
                                                     : ratio_slope(values.skin, parameter);
}

}  // namespace skinfit
