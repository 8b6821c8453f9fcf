#pragma once

#include <array>

#include "model/parameters.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// How strongly each pigment absorbs at one wavelength, in the edition's reading: molar extinctions are decadic, which
/// `printed` uses as they are and `revised` multiplies by ln 10.
struct Extinction {
    double baseline_per_cm;     ///< skin without pigments, [JACQUES98]
    double eumelanin;           ///< per cm per (g/L)
    double pheomelanin;         ///< per cm per (g/L)
    double oxyhemoglobin;       ///< per cm per (g/L)
    double deoxyhemoglobin;     ///< per cm per (g/L)
    double oxygenated_blood;    ///< the same of hemoglobin in whole blood, per cm per (g/L)
    double deoxygenated_blood;  ///< the same
    double bilirubin;           ///< per cm per (g/L); zero above 700 nm, where it is not measured
    double carotene;            ///< per cm per (g/L); zero above 700 nm, where it is not measured
    double log_wavelength;      ///< ln(wavelength / 500 nm), of the slope of the melanins

    /// Throws InputError outside the tables.
    [[nodiscard]] static Extinction at(double wavelength_nm, Edition edition);
};

/// The range of wavelengths inside all tables, nm.
struct WavelengthRange {
    double lowest_nm;
    double highest_nm;
};
[[nodiscard]] WavelengthRange modelled_wavelengths();

/// The absorption coefficient of each layer, per cm. [KA04, Eqs. 6-12], and what the paper does not have: the slope of
/// the melanins, bilirubin outside the blood and the lateral loss, all of them without effect where they are 0.
[[nodiscard]] PerLayer<double> absorption_per_cm(const Skin& skin, const Extinction& extinction);

/// Absorption coefficient times thickness of each layer.
[[nodiscard]] PerLayer<double> optical_depth(const Skin& skin, const Extinction& extinction);

/// The derivative of each layer's optical depth by `parameter`, per its unit; of a thickness the absorption coefficient
/// (without what a dermal layer scatters), zero for parameters that do not absorb.
[[nodiscard]] PerLayer<double> optical_depth_derivative(const Skin& skin, const Extinction& extinction,
                                                        Parameter parameter);

/// The derivative by `parameter` of what has these derivatives `by_optical_depth` of the layers.
[[nodiscard]] double pigment_derivative(const PerLayer<double>& by_optical_depth, const Skin& skin,
                                        const Extinction& extinction, Parameter parameter);

}  // namespace skinfit
