#include "measurements/header.hpp"

#include <algorithm>
#include <array>

#include "measurements/cells.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// `(nm)`, `[%]` and the like.
bool is_bracketed(std::string_view cell) {
    return cell.size() >= 2 &&
           ((cell.front() == '(' && cell.back() == ')') || (cell.front() == '[' && cell.back() == ']'));
}

bool is_unit(std::string_view cell) {
    static constexpr std::array<std::string_view, 4> units = {"nm", "um", "%", "percent"};
    return is_bracketed(cell) || std::ranges::find(units, lower_case(cell)) != units.end();
}

/// The cells as names where there are `width` of them, separators at the end apart; else nothing.
std::vector<std::string> as_names(std::span<const std::string_view> cells, std::size_t width) {
    if (cells.size() < width || filled_width(cells) > width) return {};
    std::vector<std::string> names;
    for (const std::string_view cell : cells.first(width)) names.push_back(unescaped(cell));
    return names;
}

std::vector<std::string> with_units_joined(std::span<const std::string_view> cells) {
    std::vector<std::string> names;
    for (const std::string_view cell : cells) {
        if (is_unit(cell) && !names.empty()) {
            names.back() += " " + std::string(cell);
        } else {
            names.push_back(unescaped(cell));
        }
    }
    return names;
}

std::vector<std::string> names_in(std::string_view line, std::size_t width, char separator) {
    CellCutter like_the_numbers(separator);
    std::vector<std::string> names = as_names(like_the_numbers.cut(line), width);
    for (const char other : {'\t', ';', ','}) {
        CellCutter cutter(other);
        if (names.empty()) names = as_names(cutter.cut(line), width);
    }
    if (!names.empty()) return names;
    CellCutter at_blanks(' ');
    names = with_units_joined(at_blanks.cut(line));
    return names.size() == width ? names : std::vector<std::string>{};
}

bool is_line_of_units(std::span<const std::string_view> cells) {
    return filled_width(cells) > 0 &&
           std::ranges::all_of(cells, [](std::string_view cell) { return cell.empty() || is_bracketed(cell); });
}

}  // namespace

bool is_line_of_words(std::span<const std::string_view> cells) {
    const auto is_word = [](std::string_view cell) { return !is_missing(cell) && !starts_like_a_number(cell); };
    const bool alone = cells.size() == 1 && !cells.front().empty() && !starts_like_a_number(cells.front());
    return alone || (cells.front().empty() ? std::ranges::any_of(cells, is_word) : is_word(cells.front()));
}

Header find_header(std::span<const Row> words, std::size_t width, char separator) {
    if (words.empty()) return {};
    CellCutter cutter(separator);
    const std::span<const std::string_view> last = cutter.cut(words.back().text);
    if (words.size() > 1 && is_line_of_units(last)) {
        const std::vector<std::string> units = as_names(last, width);
        std::vector<std::string> names = names_in(words[words.size() - 2].text, width, separator);
        if (!units.empty() && !names.empty()) {
            for (std::size_t c = 0; c < width; ++c) names[c] += units[c].empty() ? "" : " " + units[c];
            return {.lines = 2, .names = std::move(names)};
        }
    }
    std::vector<std::string> names = names_in(words.back().text, width, separator);
    return {.lines = names.empty() ? 0U : 1U, .names = std::move(names)};
}

}  // namespace skinfit
