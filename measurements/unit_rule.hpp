#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "measurements/wavelength_window.hpp"

namespace skinfit {

/// The unit of the values in a file.
enum class Unit { fraction, percent };
inline constexpr std::array<std::string_view, 2> unit_names = {"fraction", "percent"};

/// The largest value that can be a fraction: white standards and glossy samples exceed 1 by less than this.
inline constexpr double largest_fraction = 1.5;

/// The unit of some values, and how it was found.
struct UnitFinding {
    Unit unit;
    std::string rule;  ///< such as "percent: stated by the header"
};

/// What states the unit of a file's values, in order of precedence.
struct UnitStatements {
    std::optional<Unit> option;     ///< the user
    std::optional<Unit> comment;    ///< a comment in the file
    std::string_view header{};      ///< the name of the values; `values_stated` says what it states
    std::optional<Unit> named{};    ///< the same where it is known already
    std::string_view percent_in{};  ///< another spectrum of the table that is in percent, where one is; else empty
    WavelengthWindow window{};      ///< where nothing states it: of the values that are looked at
};

/// The unit as stated; where nothing states it, percent when half of `values` or more exceed `largest_fraction`, or
/// where another spectrum of the table is in percent, and fraction otherwise, so that one stray value does not rescale
/// a file. `values` must not be empty.
[[nodiscard]] UnitFinding find_unit(const UnitStatements& statements, std::span<const double> values);

/// Whether values of which nothing states the unit show that they, and the table they stand in, are in percent: half of
/// them or more exceed `largest_fraction`, and half or more do not exceed it as percent, as raw signals would. NaN
/// stands for missing values.
[[nodiscard]] bool shows_percent(std::span<const double> values);

}  // namespace skinfit
