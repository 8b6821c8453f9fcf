#include "measurements/table_refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/abscissa.hpp"
#include "measurements/cells.hpp"
#include "measurements/words.hpp"

namespace skinfit {

void refuse_word(const Columns& columns, std::size_t line, std::string_view word) {
    throw InputError({.where = at_line(columns, line),
                      .problem = fmt::format("starts with the word {}", in_quotes(word)),
                      .why = "between the header and the last reading, every line is a wavelength and its values",
                      .remedy = "delete this line or put # in front of it, or leave an empty line before text that "
                                "stands below the numbers"});
}

void refuse_unknown_wavelengths(const Columns& columns, std::span<const Row> words) {
    constexpr std::size_t fewest = 3;
    for (std::size_t i = 1; i < words.size(); ++i) {
        CellCutter cutter(words[i].text.find(',') == std::string_view::npos ? columns.separator : ',');
        if (words[i].text.find(';') != std::string_view::npos) cutter = CellCutter(';');
        if (words[i].text.find('\t') != std::string_view::npos) cutter = CellCutter('\t');
        const std::span<const std::string_view> cells = cutter.cut(words[i].text);
        const auto is_number = [](std::string_view cell) { return parse_number(cell).has_value(); };
        const auto numbers = static_cast<std::size_t>(std::ranges::count_if(cells, is_number));
        if (numbers < fewest || 2 * numbers < cells.size()) continue;
        const std::string name(cells.front());
        const std::span<const std::string_view> above = cutter.cut(words[i - 1].text);
        throw InputError({.where = at_line(columns, words[i].line),
                          .problem = fmt::format("{} seems to be a spectrum in a row, and the line above it ends in {}",
                                                 in_quotes(name), in_quotes(above.back())),
                          .why = "above spectra in rows every value needs its wavelength",
                          .remedy = "call the values 400, 410, ... or R_400, R_410, ..., by their wavelengths in nm"});
    }
}

void refuse_word_among(const Columns& columns, const Row& row, std::span<const Row> words) {
    CellCutter cutter(columns.separator);
    const std::string first(cutter.cut(row.text).front());
    const bool again = is_abscissa_name(first) || (!words.empty() && trimmed(row.text) == trimmed(words.back().text));
    const bool after_gap =
        std::ranges::none_of(columns.rows, [&](const Row& other) { return other.line + 1 == row.line; });
    if (!again && !after_gap) refuse_word(columns, row.line, first);
    throw InputError({.where = at_line(columns, row.line),
                      .problem = fmt::format("a second table seems to begin with the line {}", in_quotes(row.text)),
                      .why = "one table is read from a file",
                      .remedy = "put each table into a file of its own, or delete this line if the readings go on"});
}

void refuse_width(const Columns& columns, std::size_t line, std::size_t found, std::size_t first_line,
                  std::size_t width) {
    throw InputError({.where = at_line(columns, line),
                      .problem = fmt::format("has {} field{}", found, found == 1 ? "" : "s"),
                      .why = fmt::format("line {} has {}", first_line, width),
                      .remedy = "give every line one field per column, put names with separators in double quotes and "
                                "# before a title, and write decimal points, not commas"});
}

}  // namespace skinfit
