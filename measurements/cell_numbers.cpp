#include "measurements/cell_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/column_choice.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

bool has_decimal_commas(const Columns& columns, std::span<const std::size_t> wanted) {
    if (columns.separator != '\t' && columns.separator != ';') return false;
    return std::ranges::any_of(columns.rows, [wanted](const Row& row) {
        return std::ranges::any_of(wanted,
                                   [&row](std::size_t c) { return row.cells[c].find(',') != std::string::npos; });
    });
}

[[noreturn]] void refuse_word(const Columns& columns, std::size_t line, std::size_t column, std::string_view cell) {
    const bool commas = cell.find(',') != std::string::npos;
    throw InputError({.where = at_line(columns, line),
                      .problem = fmt::format("holds {} as {}", in_quotes(cell), label(columns, column)),
                      .why = commas ? "a decimal comma is understood between tabs or semicolons only, and is no "
                                      "separator of thousands"
                                    : "a number is needed",
                      .remedy = "correct the field or delete the line"});
}

double read_number(const Columns& columns, const Row& row, std::size_t column, bool decimal_comma) {
    const std::string_view cell = row.cells[column];
    if (is_missing(cell)) {
        throw InputError(
            {.where = at_line(columns, row.line),
             .problem = fmt::format("{} is {}", label(columns, column), cell.empty() ? "empty" : in_quotes(cell)),
             .why = "every line needs a number here",
             .remedy = "delete the line or choose another column"});
    }
    std::string text(cell);
    if (decimal_comma && text.find('.') != std::string::npos) {
        throw InputError({.where = at_line(columns, row.line),
                          .problem = fmt::format("holds {} as {}", in_quotes(cell), label(columns, column)),
                          .why = "other fields have a decimal comma, so this one can be read in two ways",
                          .remedy = "write all numbers with a decimal point and without separators of thousands"});
    }
    if (const std::size_t comma = text.find(','); decimal_comma && comma != std::string::npos) text[comma] = '.';
    const std::optional<double> number = parse_number(text);
    if (!number) refuse_word(columns, row.line, column, cell);
    if (!std::isfinite(*number)) {
        throw InputError({.where = at_line(columns, row.line),
                          .problem = fmt::format("{} is {}", label(columns, column), in_quotes(cell)),
                          .why = "only finite numbers can be used",
                          .remedy = "delete the line or choose another column"});
    }
    return *number;
}

/// The column's numbers; none where it holds words only, as a column of remarks does.
std::vector<double> read_column_with_gaps(const Columns& columns, std::size_t column, bool decimal_comma) {
    std::vector<double> numbers;
    std::optional<InputError> first_word;
    bool has_numbers = false;
    for (const Row& row : columns.rows) {
        double number = std::numeric_limits<double>::quiet_NaN();
        if (!is_missing(row.cells[column])) {
            try {
                number = read_number(columns, row, column, decimal_comma);
                has_numbers = true;
            } catch (const InputError& error) {
                if (!first_word) first_word = error;
            }
        }
        numbers.push_back(number);
    }
    if (!has_numbers) return {};
    if (first_word) throw InputError(*first_word);
    return numbers;
}

}  // namespace

std::vector<std::vector<double>> read_numbers(const Columns& columns, std::span<const std::size_t> wanted) {
    const bool decimal_comma = has_decimal_commas(columns, wanted);
    std::vector<std::vector<double>> numbers(wanted.size());
    for (const Row& row : columns.rows) {
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            numbers[i].push_back(read_number(columns, row, wanted[i], decimal_comma));
        }
    }
    return numbers;
}

std::vector<std::vector<double>> read_numbers_with_gaps(const Columns& columns, std::span<const std::size_t> wanted) {
    const bool decimal_comma = has_decimal_commas(columns, wanted);
    std::vector<std::vector<double>> numbers;
    for (const std::size_t column : wanted) {
        numbers.push_back(read_column_with_gaps(columns, column, decimal_comma));
    }
    return numbers;
}

}  // namespace skinfit
