#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "measurements/columns.hpp"

namespace skinfit {

/// True for a line that starts with a word rather than a number, or with nothing and a word after it.
[[nodiscard]] bool is_line_of_words(std::span<const std::string_view> cells);

/// The header of a table, and which of the lines above the numbers belong to it.
struct Header {
    std::size_t lines = 0;           ///< the last so many of the lines above the numbers; none where none names columns
    std::vector<std::string> names;  ///< one per column
};

/// Finds the header among the lines of words above a table of `width` columns that `separator` separates: the last of
/// them, if it gives every column a name,
/// - cut like the numbers, or
/// - cut at another separator than the numbers have, or
/// - cut at blanks, units going with the name before them: `wavelength (nm) reflectance [%]`;
/// under it may stand a line of units, as in `[nm];[%]`, which go with the names above them.
[[nodiscard]] Header find_header(std::span<const Row> words, std::size_t width, char separator);

}  // namespace skinfit
