#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"
#include "measurements/unit_rule.hpp"

/// What the readers have in common once they have numbers.
namespace skinfit {

/// The wavelengths of one or more spectra, ascending.
struct Grid {
    std::vector<double> wavelength_nm;
    std::vector<std::size_t> order;  ///< where each stands in the file
    std::string remark{};            ///< what was left out of the file's wavelengths, in words; else empty
};

/// How messages name the place of a wavelength.
struct GridPlace {
    std::string where;  ///< `a.csv:4`
    std::string which;  ///< `line 4`
};

/// Sorts the wavelengths of a file, given in its order. Detectors of one instrument may overlap: of two to six runs
/// that ascend, or descend, each with ten readings or more and each going on beyond the last, a later run's readings
/// within an earlier one are left out. Throws InputError for a wavelength outside [100, 10000] nm and for one that is
/// repeated otherwise; `place` names the i-th.
[[nodiscard]] Grid make_grid(std::span<const double> wavelength_nm, const std::function<GridPlace(std::size_t)>& place);

/// The readings of one spectrum, in the order of its file: NaN where one is missing.
struct Readings {
    std::span<const double> value;
    std::span<const double> sigma{};  ///< empty where not given
};

/// Fills wavelengths, values, sigma, `missing` and `unit_rule` of `spectrum`; percent becomes fractions. Without any
/// value all of them are empty.
void take_readings(Spectrum& spectrum, const Grid& grid, const Readings& readings, const UnitStatements& statements);
/// The same where the unit is known.
void take_readings(Spectrum& spectrum, const Grid& grid, const Readings& readings, const UnitFinding& found);

/// The quantity that a column's name or a title states; nothing where it names none or both.
[[nodiscard]] std::optional<Quantity> quantity_named(std::string_view text);

}  // namespace skinfit
