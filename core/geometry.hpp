#pragma once

#include <array>
#include <string_view>

/// The words and limits with which a measurement is described, shared by files, model and fits.
namespace skinfit {

/// What a spectrum measures.
enum class Quantity { reflectance, transmittance };
inline constexpr std::array<std::string_view, 2> quantity_names = {"reflectance", "transmittance"};

/// Whether the mirror-like reflection of the surface reaches the detector.
enum class Specular { included, excluded };
inline constexpr std::array<std::string_view, 2> specular_names = {"included", "excluded"};

/// A number between two limits, both included.
struct Range {
    double lowest;
    double highest;

    [[nodiscard]] constexpr bool contains(double number) const { return number >= lowest && number <= highest; }
};

/// As far as the model is asked.
inline constexpr Range incidence_range_deg{0, 85};       ///< to the normal
inline constexpr Range viewing_cone_range_deg{0.1, 90};  ///< half angle about the normal
inline constexpr Range bandpass_width_range_nm{0, 100};  ///< full width at half maximum
/// Standard uncertainties of fractions: far beyond any instrument's, and such that their squares are no trouble.
inline constexpr Range sigma_range{1e-9, 1e6};
/// Wider than any table: what lies outside is not in nm.
inline constexpr Range wavelength_range_nm{100, 10'000};

}  // namespace skinfit
