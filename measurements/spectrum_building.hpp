#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/declared.hpp"
#include "measurements/spectrum.hpp"
#include "measurements/unit_rule.hpp"

/// What the readers have in common once they have numbers.
namespace skinfit {

/// So many repeated wavelengths are known by their places; nobody reads more.
inline constexpr std::size_t most_repeated = 100;

/// The wavelengths of one or more spectra, ascending.
struct Grid {
    std::vector<double> wavelength_nm;
    std::vector<std::size_t> order;              ///< where each stands in the file
    std::vector<RepeatedWavelength> repeated{};  ///< at most `most_repeated`, for messages
    std::string remark{};                        ///< what was left out of the file's wavelengths, in words; else empty
};

/// How messages name the place of a wavelength.
struct GridPlace {
    std::string where;  ///< `a.csv:4`
    std::string which;  ///< `line 4`
};

/// Sorts the wavelengths of a file, given in its order; those that are repeated stay in it. But detectors of one
/// instrument may overlap: of two to six runs that ascend, or descend, each with ten readings or more and each going on
/// beyond the last, a later run's readings within an earlier one, two or more and at most half of it, are left out.
/// Throws InputError for a wavelength outside [100, 10000] nm; `place` names the i-th.
[[nodiscard]] Grid make_grid(std::span<const double> wavelength_nm, const std::function<GridPlace(std::size_t)>& place);

/// The readings of one spectrum, in the order of its file: NaN where one is missing.
struct Readings {
    std::span<const double> value;
    std::span<const double> sigma{};  ///< empty where not given
};

/// Fills wavelengths, values, sigma, `missing_nm`, `repeated` and `unit_rule` of `spectrum`; percent becomes fractions.
/// The unit is that of the values in the window of `statements`, where there are some. Without any value all of them
/// are empty.
void take_readings(Spectrum& spectrum, const Grid& grid, const Readings& readings, const UnitStatements& statements);
/// The same where the unit is known.
void take_readings(Spectrum& spectrum, const Grid& grid, const Readings& readings, const UnitFinding& found);

/// Of readings in the order of their file, those in the window that are numbers; all that are where it has none.
[[nodiscard]] std::vector<double> used_values(const WavelengthWindow& window, const Grid& grid,
                                              std::span<const double> readings);

/// What a file declares of its wavelengths, where it has several spectra: points and channels may then be anything.
[[nodiscard]] std::vector<Declared> declared_of_several(std::span<const Declared> declared);

/// The quantity that a column's name or a title states; nothing where it names none or both.
[[nodiscard]] std::optional<Quantity> quantity_named(std::string_view text);

/// Gives the spectrum the quantity that its column or row states, which goes before that of the whole file; where the
/// two differ, that is a doubt.
void name_quantity(Spectrum& spectrum, Quantity named);

}  // namespace skinfit
