#pragma once

#include <cstddef>

#include "transport/photon_paths.hpp"

/// Skin in the words of the field: plane layers with absorption and scattering coefficients.
namespace skinfit {

/// The reduced scattering coefficient of a tissue as a power of the wavelength. [JACQUES13, Eq. 1]
struct ScatteringLaw {
    double at_500_nm_per_cm;  ///< a, above 0
    double power;             ///< b, any

    /// a (wavelength / 500 nm)^-b, per cm.
    [[nodiscard]] double reduced_per_cm(double wavelength_nm) const;
    bool operator==(const ScatteringLaw&) const = default;
};

/// The layers of a `LayeredSkin`, from the top.
enum class SkinLayer : std::size_t { stratum_corneum, epidermis, papillary_dermis, reticular_dermis, subcutis };
inline constexpr std::size_t skin_layer_count = 5;

/// One skin. Fractions are of volume, from 0 to 1; concentrations 0 or more; thicknesses above 0; indices 1 or more.
struct LayeredSkin {
    double stratum_corneum_thickness_cm = 0.0015;  // thicknesses: chosen, within what anatomy knows of a forearm
    double epidermis_thickness_cm = 0.006;
    double papillary_dermis_thickness_cm = 0.02;
    double reticular_dermis_thickness_cm = 0.18;
    double subcutis_thickness_cm = 1.0;  ///< light that crosses it is lost; may be infinite

    double stratum_corneum_refractive_index = 1.5;  // of keratin; all others about that of soft tissue [JACQUES13]
    double epidermis_refractive_index = 1.4;
    double dermis_refractive_index = 1.4;
    double subcutis_refractive_index = 1.44;

    ScatteringLaw scattering{46.0, 1.421};           ///< of all above the subcutis; mean of skin [JACQUES13, Table 2]
    ScatteringLaw subcutis_scattering{18.4, 0.672};  ///< mean of other fatty tissues [JACQUES13, Table 2]
    double anisotropy = 0.8;                         ///< of all layers, -1 to 1, both excluded

    double melanosome_fraction = 0.03;  ///< of the epidermis
    double papillary_blood_fraction = 0.01;
    double reticular_blood_fraction = 0.01;
    double subcutis_blood_fraction = 0.003;
    double oxygen_saturation = 0.7;         ///< 0 to 1, in all layers
    double hemoglobin_g_per_l = 150.0;      ///< in whole blood
    double dermal_bilirubin_g_per_l = 0.0;  ///< in the tissue of the dermis, outside vessels [BOSSCHAART12]

    bool operator==(const LayeredSkin&) const = default;
};

/// Where bilirubin's band lies, against the model's table of bilirubin in chloroform, with its peak of 55000 per cm per
/// (mol/L) at 451 nm. The default is bilirubin on albumin, taken to have 48000 at 460 nm (chosen); {0, 1} is the table.
struct BilirubinBand {
    double shift_nm = 9.0;
    double factor = 0.87;
};

/// How strongly everything in skin absorbs at one wavelength; napierian. Other tables may be put in its place.
struct TissueExtinction {
    double baseline_per_cm;    ///< tissue without pigments, [JACQUES98]
    double melanosome_per_cm;  ///< 6.6e11 nm^-3.33, [JACQUES98]
    double oxyhemoglobin;      ///< per cm per (g/L)
    double deoxyhemoglobin;    ///< per cm per (g/L)
    double bilirubin;          ///< per cm per (g/L), in the band asked for

    /// Of the tables of the model. Throws InputError outside them; bilirubin's begins later by the shift.
    [[nodiscard]] static TissueExtinction at(double wavelength_nm, const BilirubinBand& band = {});
};

/// The absorption coefficient of each layer, per cm, in the order of `SkinLayer`.
[[nodiscard]] PerTurbidLayer layer_absorption_per_cm(const LayeredSkin& skin, const TissueExtinction& extinction);

/// The layers as they scatter and refract at one wavelength; what is below them has the index of the lowest.
[[nodiscard]] TurbidStack turbid_stack(const LayeredSkin& skin, double wavelength_nm);

}  // namespace skinfit
