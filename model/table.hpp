#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// What a look-up outside a table's range is.
enum class OutsideRange { error, zero };

/// A measured table with its provenance: one abscissa and named columns.
struct Table {
    std::string name;  ///< file name without ".csv"
    std::string quantity;
    std::string unit;
    std::string source;
    OutsideRange below = OutsideRange::error;
    OutsideRange above = OutsideRange::error;
    std::vector<std::string> column_names;     ///< the first is the abscissa
    std::vector<std::vector<double>> columns;  ///< columns[c][row]; the abscissa ascends strictly

    /// The values of the column called `column`; asserts that there is one.
    [[nodiscard]] const std::vector<double>& column(std::string_view column) const;
};

/// Reads a table from the text of a `model/data/*.csv` file. Throws std::logic_error when it is malformed, since the
/// tables are part of the program.
[[nodiscard]] Table parse_table(std::string_view name, std::string_view text);

/// The table of that name embedded in the program from `model/data/`.
[[nodiscard]] const Table& embedded_table(std::string_view name);

/// One column of a table as a function of wavelength, linear between the measured points.
class Curve {
public:
    /// Of one column over the wavelengths of `table`.
    Curve(const Table& table, std::string_view column);

    /// The value at `wavelength_nm`. Outside the table it is zero where the table says so; else throws InputError.
    [[nodiscard]] double operator()(double wavelength_nm) const;

private:
    const Table* table_;
    const std::vector<double>* values_;
};

}  // namespace skinfit
