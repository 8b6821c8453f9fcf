#pragma once

#include <array>
#include <string_view>

/// The words with which a measurement is described, shared by files, model and fits.
namespace skinfit {

/// What a spectrum measures.
enum class Quantity { reflectance, transmittance };
inline constexpr std::array<std::string_view, 2> quantity_names = {"reflectance", "transmittance"};

/// Whether the mirror-like reflection of the surface reaches the detector.
enum class Specular { included, excluded };
inline constexpr std::array<std::string_view, 2> specular_names = {"included", "excluded"};

}  // namespace skinfit
