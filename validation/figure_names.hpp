#pragma once

#include <array>
#include <span>
#include <string_view>

#include "model/chromophores.hpp"
#include "validation/figure.hpp"

/// The words of figures' JSON and outputs, in the order of their enumerations.
namespace skinfit {

inline constexpr std::array<std::string_view, 3> figure_kind_names = {"extinction", "spectrum", "goniophotometer"};
inline constexpr std::array<std::string_view, 3> figure_light_names = {"reflected", "subsurface", "transmitted"};

/// "printed" or "revised".
[[nodiscard]] std::string_view name_of(Edition edition);

/// What a panel of spectra or extinctions shows, as columns of tables are called: "reflectance" or "transmittance".
[[nodiscard]] std::string_view quantity_name(FigureKind kind, const FigurePanel& panel);

/// The extinction of the pigments, by their names.
struct PigmentRow {
    std::string_view name;
    double Extinction::*extinction;
};
[[nodiscard]] std::span<const PigmentRow> pigment_table();

}  // namespace skinfit
