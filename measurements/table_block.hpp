#pragma once

#include <cstddef>
#include <vector>

#include "measurements/columns.hpp"

namespace skinfit {

/// The lines of a text, cut in three: what stands above its table of readings, the table, and what stands below it.
struct TableBlock {
    std::vector<Row> before;  ///< lines of words, or of a number and prose as in `100 dark measurements taken`
    std::vector<Row> rows;
    std::vector<Row> after;  ///< end markers and logs of instruments
};

/// How the lines of a table are cut, and where their readings are known.
struct TableForm {
    char separator = ' ';
    std::size_t first = 0;  ///< the cell whose number makes a line a reading
};

/// The separator of the lines that start like a number: whichever of tab, semicolon and comma occurs in most of them;
/// in doubt the first of these, and blanks where none occurs in half of them. Where a header names wavelengths behind
/// its first cell, and words stand before the numbers below them, as in `site,wavelength,R` over `arm,400,0.08`, the
/// separator of these, and readings are known by the wavelengths.
[[nodiscard]] TableForm find_table_form(const std::vector<Row>& rows);

/// Finds the table among `rows`. Above it a line may begin with a number where it has not the shape of the table. Below
/// it stand lines without a reading that follow an empty line, or that hold no number. A line that may be a slip in a
/// row of the table, or that stands between two of its rows, stays in the table, whose reader refuses it.
[[nodiscard]] TableBlock find_table(std::vector<Row> rows, const TableForm& form);

}  // namespace skinfit
