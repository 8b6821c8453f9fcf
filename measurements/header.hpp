#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "measurements/columns.hpp"

namespace skinfit {

/// True for a line that starts with a word rather than a number, or with nothing and a word after it.
[[nodiscard]] bool is_line_of_words(std::span<const std::string_view> cells);

/// Whether the first row of a table is a header in which specimens are called by whole numbers: `,401,402` over
/// `400,0.08,0.07`.
[[nodiscard]] bool is_header_of_numbers(const Row& first, const Row& second, char separator);

/// True for a cell that is a unit and nothing else: `nm`, `%`, `a.u.`, `(nm)`, `[-]`.
[[nodiscard]] bool is_unit(std::string_view cell);

/// The header of a table, and which of the lines above the numbers belong to it.
struct Header {
    std::size_t lines = 0;           ///< the last so many of the lines above the numbers; none where none names columns
    std::size_t line = 0;            ///< that of the names, counted from 1
    std::vector<std::string> names;  ///< one per column
    std::vector<TitleLine> titles{};  ///< what other lines give each column; of these, those that state nothing about
                                      ///< values are not among `lines`
};

/// Finds the header among the lines of words above a table of `width` columns that `separator` separates: the last of
/// them, if it gives every column a name,
/// - cut like the numbers, or
/// - cut at another separator than the numbers have, or
/// - cut at blanks, units going with the name before them: `wavelength (nm) reflectance [%]`;
/// under it may stand a line of units, as in `[nm];[%]`, which go with the names above them. About it may stand lines
/// that give each column something, as its subject, or its quantity in `Quantity,Absorbance,Reflectance`.
[[nodiscard]] Header find_header(std::span<const Row> words, std::size_t width, char separator);

}  // namespace skinfit
