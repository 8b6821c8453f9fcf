#include "measurements/header.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/text.hpp"
#include "measurements/abscissa.hpp"
#include "measurements/cells.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// `(nm)`, `[%]` and the like.
bool is_bracketed(std::string_view cell) {
    return cell.size() >= 2 &&
           ((cell.front() == '(' && cell.back() == ')') || (cell.front() == '[' && cell.back() == ']'));
}

/// A unit that between blanks is none of the names.
bool goes_with_name(std::string_view cell) {
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
        if (goes_with_name(cell) && !names.empty()) {
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

/// The cells of a line where it may give each of `width` columns something; else nothing.
std::vector<std::string> cells_of(const Row& row, std::size_t width, char separator) {
    CellCutter cutter(separator);
    const std::span<const std::string_view> cells = cutter.cut(row.text);
    const bool between_blanks = separator == ' ';
    if (filled_width(cells) > width || (between_blanks && !std::ranges::all_of(cells, is_unit))) return {};
    std::vector<std::string> found(width);
    for (std::size_t c = 0; c < std::min(width, cells.size()); ++c) found[c] = unescaped(cells[c]);
    return found;
}

std::size_t count_filled(const std::vector<std::string>& cells) {
    return cells.size() - static_cast<std::size_t>(std::ranges::count(cells, std::string{}));
}

/// Beside a key for values, or nothing, stands what is stated of each column's values.
bool states_values(const std::vector<std::string>& cells) {
    if (cells.size() < 3 || count_filled(cells) < 2) return false;
    const bool keyed = is_ordinate_key(cells.front());
    const auto states = [&](const std::string& cell) {
        const ValueStatement stated = keyed ? values_stated_by_letter(cell) : values_stated(cell);
        return cell.empty() || is_unit(cell) || stated.quantity || stated.unit || !stated.unusable.empty() ||
               specular_stated(cell);
    };
    const bool free_front = keyed || cells.front().empty() || specular_stated(cells.front(), "yes");
    return free_front && std::all_of(cells.begin() + 1, cells.end(), states);
}

/// A line of units below the names.
bool is_line_of_units(const std::vector<std::string>& cells) {
    const auto fits = [](const std::string& cell) { return cell.empty() || is_unit(cell); };
    const auto first = std::ranges::find_if(cells, [](const std::string& cell) { return !cell.empty(); });
    return first != cells.end() && *first != "1" && *first != "-" && std::ranges::all_of(cells, fits);
}

/// Whether cells above the names name specimens: with none above the wavelengths, one above each column, or one above
/// several columns each. `key,value` does not, whatever empty cells follow.
bool gives_names(const std::vector<std::string>& cells, bool is_next) {
    const std::size_t filled = count_filled(cells);
    if (cells.size() < 3) return false;
    if (filled > 0 && cells.front().empty()) return true;
    return filled == cells.size() || (is_next && filled >= 2 && (filled > 2 || cells[1].empty()));
}

/// Joins the units below names to them: those in brackets, and that of wavelengths.
void join_units(std::vector<std::string>& names, std::vector<std::string>& units) {
    for (std::size_t c = 0; c < names.size(); ++c) {
        const bool bracketed = is_bracketed(units[c]);
        if (units[c].empty() || names[c].empty() || (!bracketed && !is_abscissa_name(names[c]))) continue;
        names[c] += bracketed ? " " + units[c] : " (" + units[c] + ")";
        units[c].clear();
    }
}

/// The lines above the names, from the bottom; `header.lines` counts those that state something of values.
void take_titles(Header& header, std::span<const Row> above, std::size_t width, char separator) {
    constexpr std::size_t most = 6;
    std::size_t below = header.line;
    bool counts = true;
    for (std::size_t i = above.size(); i-- > 0 && header.titles.size() < most; below = above[i].line) {
        std::vector<std::string> cells = cells_of(above[i], width, separator);
        if (above[i].line + 1 != below || cells.empty()) break;
        const bool statement = states_values(cells);
        if (!statement && !gives_names(cells, header.titles.empty())) break;
        counts = counts && statement;
        if (counts) ++header.lines;
        header.titles.insert(header.titles.begin(),
                             {.line = above[i].line, .cells = std::move(cells), .is_statement = statement});
    }
}

}  // namespace

bool is_unit(std::string_view cell) {
    static constexpr std::array<std::string_view, 14> units = {
        "nm", "um", "\u00b5m", "\u03bcm", "%", "percent", "1", "-", "abs", "au", "a.u.", "fraction", "cm-1", "1/cm"};
    return is_bracketed(cell) || std::ranges::find(units, lower_case(cell)) != units.end();
}

bool is_line_of_words(std::span<const std::string_view> cells) {
    const auto is_word = [](std::string_view cell) { return !is_missing(cell) && !starts_like_a_number(cell); };
    const bool alone = cells.size() == 1 && !cells.front().empty() && !starts_like_a_number(cells.front());
    return alone || (cells.front().empty() ? std::ranges::any_of(cells, is_word) : is_word(cells.front()));
}

bool is_header_of_numbers(const Row& first, const Row& second, char separator) {
    constexpr double least = 100;  // chosen: beyond readings in percent
    CellCutter cutter(separator);
    const std::span<const std::string_view> cells = cutter.cut(first.text);
    const auto is_name = [](std::string_view cell) {
        const std::optional<double> number = parse_number(cell);
        return number && *number >= least && cell.find_first_not_of("0123456789") == std::string_view::npos;
    };
    return cells.size() > 1 && cells.front().empty() && std::ranges::all_of(cells.subspan(1), is_name) &&
           parse_number(cutter.cut(second.text).front());
}

Header find_header(std::span<const Row> words, std::size_t width, char separator) {
    if (words.empty()) return {};
    Header header;
    std::vector<TitleLine> units;
    std::size_t end = words.size();
    for (; end > 1; --end) {
        const std::vector<std::string> cells = cells_of(words[end - 1], width, separator);
        const bool of_units = !cells.empty() && is_line_of_units(cells);
        const bool states = !of_units && !cells.empty() && states_values(cells);
        if (!of_units && !states) break;
        const std::vector<std::string> above = names_in(words[end - 2].text, width, separator);
        if (above.empty() || (cells.front().empty() && !is_abscissa_name(above.front()))) break;
        if (of_units) units.push_back({.line = words[end - 1].line, .cells = cells, .is_statement = true});
        if (states) header.titles.push_back({.line = words[end - 1].line, .cells = cells, .is_statement = true});
    }
    header.names = names_in(words[end - 1].text, width, separator);
    if (header.names.empty()) return {};
    header.line = words[end - 1].line;
    header.lines = words.size() - end + 1;
    for (TitleLine& each : units) {
        join_units(header.names, each.cells);
        if (count_filled(each.cells) > 0) header.titles.push_back(std::move(each));
    }
    take_titles(header, words.first(end - 1), width, separator);
    return header;
}

}  // namespace skinfit
