#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "measurements/columns.hpp"

/// What is wrong with lines of a table. All throw InputError.
namespace skinfit {

[[noreturn]] void refuse_word(const Columns& columns, std::size_t line, std::string_view word);

/// Where rows of names and numbers stand below a header that names no wavelengths as such; else returns.
void refuse_unknown_wavelengths(const Columns& columns, std::span<const Row> words);

/// Refuses a row that starts with a word, perhaps the header of a second table. `words` are the lines above the first.
[[noreturn]] void refuse_word_among(const Columns& columns, const Row& row, std::span<const Row> words);

/// Refuses a line of `found` cells where `first_line` has `width`.
[[noreturn]] void refuse_width(const Columns& columns, std::size_t line, std::size_t found, std::size_t first_line,
                               std::size_t width);

}  // namespace skinfit
