#include "measurements/cell_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

bool has_decimal_commas(const Columns& columns, std::span<const std::size_t> wanted) {
    if (columns.separator != '\t' && columns.separator != ';') return false;
    CellCutter cutter(columns.separator);
    return std::ranges::any_of(columns.rows, [&](const Row& row) {
        if (row.text.find(',') == std::string_view::npos) return false;
        const std::span<const std::string_view> cells = cutter.cut(row.text);
        return std::ranges::any_of(wanted, [&](std::size_t c) { return cells[c].find(',') != std::string_view::npos; });
    });
}

[[noreturn]] void refuse_word(const std::string& where, const std::string& name, std::string_view cell) {
    const bool commas = cell.find(',') != std::string::npos;
    throw InputError({.where = where,
                      .problem = fmt::format("holds {} as {}", in_quotes(cell), name),
                      .why = commas ? "a decimal comma is understood between tabs or semicolons only, and is no "
                                      "separator of thousands"
                                    : "a number is needed",
                      .remedy = "correct the field or delete the line"});
}

/// A cell that is neither a number nor missing.
struct CellWord {
    std::size_t line;
    std::string_view cell;
};

/// A table, and of each column its first cell that is neither a number nor missing.
struct GlancedTable {
    NumberTable table;
    bool decimal_comma;
    std::vector<std::optional<CellWord>> first_word;
};

GlancedTable glance(const Columns& columns, std::span<const std::size_t> wanted) {
    GlancedTable found{.table = {.width = wanted.size(),
                                 .cells = std::vector<double>(wanted.size() * columns.rows.size()),
                                 .holds_words = std::vector<bool>(wanted.size(), true)},
                       .decimal_comma = has_decimal_commas(columns, wanted),
                       .first_word = std::vector<std::optional<CellWord>>(wanted.size())};
    NumberTable& table = found.table;
    CellCutter cutter(columns.separator);
    double* next = table.cells.data();
    for (const Row& row : columns.rows) {
        const std::span<const std::string_view> cells = cutter.cut(row.text);
        for (std::size_t i = 0; i < wanted.size(); ++i, ++next) {
            const std::string_view cell = cells[wanted[i]];
            const std::optional<double> number = parse_cell(cell, found.decimal_comma);
            if (number && std::isfinite(*number)) {
                *next = *number;
                if (table.holds_words[i]) table.holds_words[i] = false;
                continue;
            }
            *next = std::numeric_limits<double>::quiet_NaN();
            if (!found.first_word[i] && !is_missing(cell)) {
                found.first_word[i] = CellWord{.line = row.line, .cell = cell};
            }
        }
    }
    return found;
}

}  // namespace

std::optional<double> parse_cell(std::string_view cell, bool decimal_comma) {
    if (!decimal_comma) return parse_number(cell);
    if (cell.find('.') != std::string_view::npos) return std::nullopt;
    std::string text(cell);
    if (const std::size_t comma = text.find(','); comma != std::string::npos) text[comma] = '.';
    return parse_number(text);
}

void refuse_cell(const std::string& where, const std::string& name, std::string_view cell, bool decimal_comma) {
    if (is_missing(cell)) {
        throw InputError({.where = where,
                          .problem = fmt::format("{} is {}", name, cell.empty() ? "empty" : in_quotes(cell)),
                          .why = "every line needs a number here",
                          .remedy = "delete the line or choose another column"});
    }
    if (decimal_comma && cell.find('.') != std::string_view::npos) {
        throw InputError({.where = where,
                          .problem = fmt::format("holds {} as {}", in_quotes(cell), name),
                          .why = "other fields have a decimal comma, so this one can be read in two ways",
                          .remedy = "write all numbers with a decimal point and without separators of thousands"});
    }
    if (!parse_cell(cell, decimal_comma)) refuse_word(where, name, cell);
    throw InputError({.where = where,
                      .problem = fmt::format("{} is {}", name, in_quotes(cell)),
                      .why = "only finite numbers can be used",
                      .remedy = "delete the line or choose another column"});
}

std::vector<std::vector<double>> read_numbers(const Columns& columns, std::span<const std::size_t> wanted) {
    const bool decimal_comma = has_decimal_commas(columns, wanted);
    std::vector<std::vector<double>> numbers(wanted.size());
    CellCutter cutter(columns.separator);
    for (const Row& row : columns.rows) {
        const std::span<const std::string_view> cells = cutter.cut(row.text);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const std::string_view cell = cells[wanted[i]];
            const std::optional<double> number = parse_cell(cell, decimal_comma);
            if (!number || !std::isfinite(*number)) {
                refuse_cell(at_line(columns, row.line), label(columns, wanted[i]), cell, decimal_comma);
            }
            numbers[i].push_back(*number);
        }
    }
    return numbers;
}

NumberTable read_number_table(const Columns& columns, std::span<const std::size_t> wanted) {
    GlancedTable glanced = glance(columns, wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const std::optional<CellWord>& word = glanced.first_word[i];
        if (glanced.table.holds_words[i] || !word) continue;
        refuse_cell(at_line(columns, word->line), label(columns, wanted[i]), word->cell, glanced.decimal_comma);
    }
    return {std::move(glanced.table)};
}

NumberTable glance_at_numbers(const Columns& columns, std::span<const std::size_t> wanted) {
    return glance(columns, wanted).table;
}

}  // namespace skinfit
