#include "measurements/table_block.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "core/text.hpp"
#include "measurements/abscissa.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/header.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// A number, with a point or a comma.
bool is_number(std::string_view cell) {
    return parse_cell(cell, false) || parse_cell(cell, true);
}

/// What one line looks like as a row of a table.
struct Look {
    std::size_t width = 0;     ///< filled cells
    bool is_reading = false;   ///< a number first, and another number; between blanks nothing but numbers
    bool is_empty = false;     ///< a number first, and empty cells
    bool has_numbers = false;  ///< behind its first cell
};

/// The cells from the first that counts on.
std::span<const std::string_view> cells_from(CellCutter& cutter, std::string_view line, std::size_t first) {
    const std::span<const std::string_view> all = cutter.cut(line);
    return all.size() > first ? all.subspan(first) : all.first(1);
}

Look look_at(const Row& row, const TableForm& form) {
    const char separator = form.separator;
    CellCutter cutter(separator);
    const std::span<const std::string_view> all = cells_from(cutter, row.text, form.first);
    Look look{.width = filled_width(all)};
    if (look.width == 0) return look;
    look.is_empty = look.width == 1 && all.size() > 1 && is_number(all.front());
    const std::span<const std::string_view> others = all.subspan(1, look.width - 1);
    look.has_numbers = std::ranges::any_of(others, is_number);
    const bool first = is_number(all.front()) || all.front().empty();
    const auto fits = [](std::string_view cell) { return is_number(cell) || is_missing(cell); };
    const bool no_prose = separator != ' ' || std::ranges::all_of(others, fits);
    const bool holds_one =
        std::ranges::any_of(others, [&](std::string_view cell) { return !cell.empty() && fits(cell); });
    look.is_reading = first && holds_one && no_prose;
    return look;
}

bool is_words(const Row& row, const TableForm& form) {
    CellCutter cutter(form.separator);
    return is_line_of_words(cells_from(cutter, row.text, form.first));
}

/// Where the table begins: at the first line that starts like a number, unless that is prose of another shape than the
/// first two readings in a row.
std::size_t find_start(const std::vector<Row>& rows, const TableForm& form) {
    const auto first = std::ranges::find_if(rows, [&](const Row& row) { return !is_words(row, form); });
    const auto begin = static_cast<std::size_t>(first - rows.begin());
    for (std::size_t s = begin; s < rows.size(); ++s) {
        const Look here = look_at(rows[s], form);
        if (!here.is_reading) continue;
        const bool is_last = s + 1 == rows.size();
        const Look next = is_last ? here : look_at(rows[s + 1], form);
        if (!next.is_reading || next.width != here.width) continue;
        bool words_between = false;
        std::size_t start = s;
        for (std::size_t i = s; i-- > begin;) {
            const Look look = look_at(rows[i], form);
            if (is_words(rows[i], form)) {
                words_between = true;
            } else if (look.width == here.width || ((look.is_reading || look.is_empty) && !words_between)) {
                start = i;
            }
        }
        return start;
    }
    return begin;
}

bool ends_a_table(std::string_view text) {
    const std::string line = lower_case(trimmed(text));
    return line.starts_with("end") || line.starts_with("[end") || line.starts_with("eof") || line.starts_with(">>>") ||
           line.starts_with("***") || line.starts_with("---") || line.starts_with("===");
}

/// Where the table ends: at its first line that is no reading, if all that follows is no table.
std::size_t find_end(const std::vector<Row>& rows, std::size_t start, const TableForm& form) {
    if (start >= rows.size()) return rows.size();
    const std::size_t width = look_at(rows[start], form).width;
    const char separator = form.separator;
    CellCutter cutter(separator);
    for (std::size_t k = start + 1; k < rows.size(); ++k) {
        RowShape shape = cutter.shape(rows[k].text);
        if (form.first > 0) {
            const std::span<const std::string_view> cells = cells_from(cutter, rows[k].text, form.first);
            shape = {.width = cells.size(), .filled = filled_width(cells), .first = cells.front()};
        }
        const bool after_gap = rows[k].line > rows[k - 1].line + 1;
        const bool word = !starts_like_a_number(shape.first) && !is_missing(shape.first);
        const bool other_shape = after_gap && shape.filled != width;
        if (!word && !other_shape) continue;
        const Look look = look_at(rows[k], form);
        if (look.is_reading) continue;
        // A number misspelt holds a digit, as `O400` does; one line alone may be anything.
        const bool like_a_number =
            k + 1 == rows.size() || shape.first.find_first_of("0123456789") != std::string_view::npos;
        const bool may_be_slip =
            look.has_numbers && like_a_number && (separator == ' ' ? !after_gap : look.width == width);
        const bool readings_follow = [&] {
            for (std::size_t i = k + 1; i < rows.size(); ++i) {
                const Look other = look_at(rows[i], form);
                if (other.is_reading && (other.width == width || !after_gap)) return true;
            }
            return false;
        }();
        const bool told = after_gap || !look.has_numbers || !like_a_number || ends_a_table(rows[k].text);
        return !may_be_slip && !readings_follow && told ? k : rows.size();
    }
    return rows.size();
}

char find_separator(const std::vector<Row>& rows) {
    constexpr std::array candidates{'\t', ';', ','};
    std::array<std::size_t, candidates.size()> occurrences{};
    std::size_t lines = 0;
    for (const Row& row : rows) {
        const std::string_view text = trimmed(row.text);
        if (!starts_like_a_number(text.substr(text.starts_with('"') ? 1 : 0))) continue;
        ++lines;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (text.find(candidates[i]) != std::string_view::npos) ++occurrences[i];
        }
    }
    const auto most = std::ranges::max_element(occurrences);
    return 2 * *most < lines || *most == 0 ? ' ' : candidates[static_cast<std::size_t>(most - occurrences.begin())];
}

/// The form of a table whose header is `header`, where words stand before the wavelengths in the line below.
std::optional<TableForm> form_with_words_in_front(const Row& header, const Row& below) {
    for (const char separator : {'\t', ';', ',', ' '}) {
        CellCutter cutter(separator);
        const std::span<const std::string_view> names = cutter.cut(header.text);
        const auto found = std::ranges::find_if(names, is_abscissa_name);
        const std::size_t width = names.size();
        const auto first = static_cast<std::size_t>(found - names.begin());
        if (first == 0 || first == width || std::ranges::any_of(names, is_number)) continue;
        const std::span<const std::string_view> cells = cutter.cut(below.text);
        if (cells.size() != width || cells.front().empty() || starts_like_a_number(cells.front())) continue;
        if (is_number(cells[first]) && (first + 1 == width || is_number(cells[first + 1]) || width > first + 2)) {
            return TableForm{.separator = separator, .first = first};
        }
    }
    return std::nullopt;
}

}  // namespace

TableForm find_table_form(const std::vector<Row>& rows) {
    constexpr std::size_t most_above = 100;  // as of spectra in rows
    for (std::size_t i = 0; i + 1 < std::min(rows.size(), most_above); ++i) {
        if (const auto form = form_with_words_in_front(rows[i], rows[i + 1])) return *form;
        if (starts_like_a_number(trimmed(rows[i].text))) break;
    }
    return {.separator = find_separator(rows)};
}

TableBlock find_table(std::vector<Row> rows, const TableForm& form) {
    const std::size_t start = find_start(rows, form);
    const std::size_t end = find_end(rows, start, form);
    const auto at = [&rows](std::size_t i) { return rows.begin() + static_cast<std::ptrdiff_t>(i); };
    TableBlock block{.before = {rows.begin(), at(start)}, .rows = {}, .after = {at(end), rows.end()}};
    rows.erase(at(end), rows.end());
    rows.erase(rows.begin(), at(start));
    block.rows = std::move(rows);
    return block;
}

}  // namespace skinfit
