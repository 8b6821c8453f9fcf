#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "measurements/columns.hpp"

namespace skinfit {

/// The numbers in some columns of a table, in the order asked for: `numbers[i][row]`, all finite.
///
/// Decimal comma: between tabs or semicolons, a comma in any of these cells makes the comma the decimal mark of all of
/// them, and a point in any of them is then an error. Between commas or blanks only points are decimal marks.
///
/// Throws InputError, naming line and column, for a cell that is empty, no number, or not finite.
[[nodiscard]] std::vector<std::vector<double>> read_numbers(const Columns& columns,
                                                            std::span<const std::size_t> wanted);

/// The same where cells may be missing (`is_missing`): NaN stands for them, and a column without any number gives no
/// numbers at all. A column with numbers must hold nothing but numbers and missing cells.
[[nodiscard]] std::vector<std::vector<double>> read_numbers_with_gaps(const Columns& columns,
                                                                      std::span<const std::size_t> wanted);

}  // namespace skinfit
