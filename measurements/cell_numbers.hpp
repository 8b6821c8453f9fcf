#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/columns.hpp"

namespace skinfit {

/// The cell's number, finite or not, if it is one. With a decimal comma, a point makes it none.
[[nodiscard]] std::optional<double> parse_cell(std::string_view cell, bool decimal_comma);

/// Throws InputError for a cell that is missing, no number or not finite; `name` is that of its column.
[[noreturn]] void refuse_cell(const std::string& where, const std::string& name, std::string_view cell,
                              bool decimal_comma);

/// The numbers in some columns of a table, in the order asked for: `numbers[i][row]`, all finite.
///
/// Decimal comma: between tabs or semicolons, a comma in any of these cells makes the comma the decimal mark of all of
/// them, and a point in any of them is then an error. Between commas or blanks only points are decimal marks.
///
/// Throws InputError, naming line and column, for a cell that is empty, no number, or not finite.
[[nodiscard]] std::vector<std::vector<double>> read_numbers(const Columns& columns,
                                                            std::span<const std::size_t> wanted);

/// The numbers in some columns, row after row. NaN stands for missing cells (`is_missing`).
struct NumberTable {
    std::size_t width = 0;
    std::vector<double> cells;
    std::vector<bool> holds_words;  ///< for each column: it holds words, or nothing, and no number at all
};

/// The same where cells may be missing, and where columns of words may stand beside those of numbers. A column with
/// numbers must hold nothing but numbers and missing cells.
[[nodiscard]] NumberTable read_number_table(const Columns& columns, std::span<const std::size_t> wanted);

/// The same where words among numbers count as missing: to look at columns that are not asked for.
[[nodiscard]] NumberTable glance_at_numbers(const Columns& columns, std::span<const std::size_t> wanted);

}  // namespace skinfit
