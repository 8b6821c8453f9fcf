#pragma once

#include <array>
#include <string_view>

#include "validation/figure.hpp"

/// The words of figures' JSON and outputs, in the order of their enumerations.
namespace skinfit {

inline constexpr std::array<std::string_view, 2> figure_kind_names = {"spectrum", "goniophotometer"};
inline constexpr std::array<std::string_view, 3> figure_light_names = {"reflected", "subsurface", "transmitted"};

/// "printed" or "revised".
[[nodiscard]] std::string_view name_of(Edition edition);

/// "reflectance" or "transmittance": what a panel of spectra shows.
[[nodiscard]] std::string_view quantity_name(const FigurePanel& panel);

}  // namespace skinfit
