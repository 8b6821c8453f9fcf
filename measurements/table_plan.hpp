#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measurements/abscissa.hpp"
#include "measurements/columns.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/value_statement.hpp"

namespace skinfit {

/// What a column of a table holds.
enum class ColumnRole { wavelength, value, sigma, unused };

/// One column and what its name, and the lines about the table, state of it.
struct PlannedColumn {
    ColumnRole role = ColumnRole::value;
    std::string name{};                  ///< by which it is chosen; that of its title line where names are repeated
    std::string header{};                ///< what its header says: the name there, else that of its title line
    std::string reason{};                ///< of `unused`: why
    bool is_other_quantity = false;      ///< unused because it is neither reflectance nor transmittance
    ValueStatement states{};             ///< of `value`; of `sigma` its unit
    std::optional<Specular> specular{};  ///< of `value`
    std::size_t wavelength = 0;          ///< of `value` and `sigma`: the column of its wavelengths
    std::optional<std::size_t> sigma{};  ///< of `value`: the column of its standard uncertainties
    Abscissa abscissa{.name = "nm"};     ///< of `wavelength`

    void leave_out(std::string why) {
        role = ColumnRole::unused;
        reason = std::move(why);
    }
};

/// All columns of a table, in the order of the file.
struct TablePlan {
    std::vector<PlannedColumn> columns;
    std::size_t first_wavelength = 0;
    std::size_t values = 0;              ///< columns of values
    std::vector<std::string> remarks{};  ///< what is left out or in doubt, in words

    /// The column's name or number in words, for messages.
    [[nodiscard]] std::string label(std::size_t column) const;
    /// The number by which `--column` knows a column: counted from the first column of wavelengths, which is 0.
    [[nodiscard]] std::size_t number_of(std::size_t column) const { return column - first_wavelength; }
};

/// Says what each column of a table holds.
///
/// The wavelengths are in the column whose name says so, else in the first; without such names, in every other column
/// where these are called x or hold what looks like wavelengths. What stands before it without a name, or called index,
/// id and the like, is left out, as are conditions such as a temperature or bandpass. Of several columns of wavelengths
/// each belongs to the values behind it; side by side they are one axis in several units, of which nm is taken.
/// Uncertainties belong to the column that they name, else to the one before them or, where they stand at an end of the
/// table, to all. Columns that are neither reflectance nor transmittance by their name, or by what the file states
/// where their name states nothing, are unused.
///
/// Throws InputError where no wavelengths are stated to be along the spectra but something else.
[[nodiscard]] TablePlan plan_table(const Columns& columns, const FileStatements& statements);

}  // namespace skinfit
