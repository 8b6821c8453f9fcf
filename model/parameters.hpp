#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "model/skin.hpp"

namespace skinfit {

/// How the instrument departs from an ideal spectrophotometer.
struct Instrument {
    double scale = 1.0;                ///< measured = scale * (reflectance or transmittance) + offset
    double offset = 0.0;               ///< stray light, fraction
    double specular_fraction = 0.0;    ///< of the surface reflectance, seen where specular is excluded
    double wavelength_shift_nm = 0.0;  ///< the model is evaluated at the stated wavelength plus this
};

/// Every number the model depends on.
struct ParameterValues {
    Skin skin;
    Instrument instrument;
};

/// Every parameter, in the order of `parameter_table()`.
enum class Parameter : std::size_t {
    melanosome_fraction,
    eumelanin_g_per_l,
    pheomelanin_g_per_l,
    melanin_slope,
    papillary_blood_fraction,
    reticular_blood_fraction,
    oxygen_saturation,
    hemoglobin_g_per_l,
    whole_blood_share,
    bilirubin_g_per_l,
    dermal_bilirubin_g_per_l,
    stratum_corneum_carotene_g_per_l,
    epidermis_carotene_g_per_l,
    dermis_carotene_g_per_l,
    lateral_loss_per_cm,
    stratum_corneum_thickness_cm,
    epidermis_thickness_cm,
    papillary_dermis_thickness_cm,
    reticular_dermis_thickness_cm,
    stratum_corneum_refractive_index,
    epidermis_refractive_index,
    papillary_dermis_refractive_index,
    reticular_dermis_refractive_index,
    fibre_refractive_index,
    fibril_radius_nm,
    fold_aspect_ratio,
    scale,
    offset,
    specular_fraction,
    wavelength_shift_nm,
};
inline constexpr std::size_t parameter_count = 30;

/// One row of the vocabulary: the one place that knows a parameter's name, unit and ranges.
struct ParameterInfo {
    Parameter parameter;
    std::string_view name;  ///< C++ field, JSON key, CSV column and report row
    std::string_view unit;  ///< empty for a pure number
    double lowest;          ///< smallest accepted value
    double highest;         ///< largest accepted value
    double lower;           ///< default bounds of a fit
    double upper;
    bool steers;               ///< changes where rays go, not only how much of them is absorbed
    std::string_view meaning;  ///< one line for help texts
    std::string_view source;   ///< of the default and of the bounds
};

/// All parameters, in the order of `Parameter`.
[[nodiscard]] std::span<const ParameterInfo, parameter_count> parameter_table();

/// The row of one parameter.
[[nodiscard]] const ParameterInfo& info(Parameter parameter);

/// Whether the parameter is a field of `Instrument` rather than of `Skin`.
[[nodiscard]] bool belongs_to_instrument(Parameter parameter);

/// Whether 0 is a value that skin and instrument may have: an amount of what absorbs, or a share of light that is lost
/// or seen.
[[nodiscard]] bool may_be_absent(Parameter parameter);

/// The parameter of that name, if there is one.
[[nodiscard]] std::optional<Parameter> find_parameter(std::string_view name);

/// The value of one parameter, to read or to change.
[[nodiscard]] double& value_of(ParameterValues& values, Parameter parameter);
[[nodiscard]] double value_of(const ParameterValues& values, Parameter parameter);

}  // namespace skinfit
