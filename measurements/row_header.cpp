#include "measurements/row_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <span>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/limits.hpp"
#include "measurements/wavelength_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

char separator_of(std::string_view line) {
    constexpr std::array marks = {'\t', ';', ','};  // a comma may be decimal
    const auto most = std::ranges::max_element(marks, {}, [line](char c) { return std::ranges::count(line, c); });
    return line.find(*most) == std::string_view::npos ? ' ' : *most;
}

bool is_monotonic(std::span<const double> numbers) {
    return std::ranges::adjacent_find(numbers, std::ranges::greater_equal{}) == numbers.end() ||
           std::ranges::adjacent_find(numbers, std::ranges::less_equal{}) == numbers.end();
}

bool are_wavelengths(std::span<const double> nm) {
    return std::ranges::all_of(nm, [](double each) { return wavelength_range_nm.contains(each); }) && is_monotonic(nm);
}

/// The same of a header, in which one of ten may be out of the range, or begin what another detector has measured.
bool are_mostly_wavelengths(std::span<const double> nm) {
    constexpr std::size_t share = 10;  // chosen
    std::vector<double> inside;
    std::ranges::copy_if(nm, std::back_inserter(inside),
                         [](double each) { return wavelength_range_nm.contains(each); });
    if (share * (nm.size() - inside.size()) > nm.size() || inside.size() < 2) return false;
    std::size_t up = 0;
    for (std::size_t i = 1; i < inside.size(); ++i) up += inside[i] > inside[i - 1] ? 1 : 0;
    std::size_t down = 0;
    for (std::size_t i = 1; i < inside.size(); ++i) down += inside[i] < inside[i - 1] ? 1 : 0;
    return share * (inside.size() - 1 - std::max(up, down)) <= inside.size() - 1;
}

/// The first lines of a text with something on them.
struct TopLines {
    std::vector<Row> rows;
    std::optional<Row> comment;  ///< the last above the first row
};

TopLines top_lines(std::string_view text) {
    constexpr std::size_t most = 100;
    TopLines top;
    LineReader reader(text);
    std::size_t number = 0;
    while (top.rows.size() < most) {
        const auto line = reader.next();
        if (!line) break;
        ++number;
        const std::string_view content = trimmed(*line);
        if (content.empty()) continue;
        if (content.front() != '#') {
            top.rows.push_back({.line = number, .text = *line});
        } else if (top.rows.empty()) {
            top.comment = Row{.line = number, .text = trimmed(content.substr(1))};
        }
    }
    return top;
}

constexpr double clearly_wider = 2;  // chosen: names of specimens seldom span half as much as a spectrum

/// The corner of a data frame.
bool is_nameless(std::string_view corner) {
    return corner.empty() || lower_case(corner).starts_with("unnamed");
}

/// How far wavelengths reach that may stand in the first column below the header; 0 where these are none.
double span_of_first_column(const RowHeader& header, std::span<const Row> below) {
    std::vector<double> numbers;
    CellCutter cutter(header.separator);
    for (const Row& row : below) {
        const std::span<const std::string_view> cells = cutter.cut(row.text);
        if (filled_width(cells) == 0) continue;
        const std::optional<double> number = parse_cell(cells.front(), header.separator == ';');
        if (!number && !parse_number(cells.front())) return 0;
        numbers.push_back(number ? *number : *parse_number(cells.front()));
    }
    const std::optional<Abscissa> corner =
        is_nameless(header.labels.front()) ? Abscissa{.name = "nm"} : abscissa_stated(header.labels.front());
    if (numbers.empty() || !corner || !corner->unusable.empty()) return 0;
    const std::vector<double> nm = wavelengths_nm(*corner, numbers);
    return are_wavelengths(nm) ? std::abs(nm.back() - nm.front()) : 0;
}

bool corner_speaks_of_wavelengths(const RowHeader& header) {
    return is_abscissa_name(header.labels.front());
}

/// Where the corner speaks of wavelengths, how much wider the range of the header is than that of the first column.
std::optional<double> range_ratio(const RowHeader& header, std::span<const Row> below) {
    const bool nameless = is_nameless(header.labels.front());
    if (!corner_speaks_of_wavelengths(header) && !nameless) return std::nullopt;
    const std::vector<double> nm = header.wavelength_nm();
    const double along = std::abs(nm.back() - nm.front());
    const double down = span_of_first_column(header, below);
    const double ratio = down > 0 ? along / down : HUGE_VAL;
    // Without a word for wavelengths the rows may be called by any numbers.
    return nameless && ratio > 1 / clearly_wider ? std::nullopt : std::optional(ratio);
}

struct FoundHeader {
    RowHeader header;
    std::span<const Row> below;
};

/// The cells of `below`, cut as the header is.
std::size_t width_of(const Row& header, const Row& below) {
    CellCutter cutter(separator_of(header.text));
    return filled_width(cutter.cut(below.text));
}

/// What a line above the header says of each block: `,SCI,SCI,...,SCE,SCE,...`.
void take_line_above(RowHeader& header, const Row& above) {
    CellCutter cutter(header.separator);
    const std::span<const std::string_view> cells = cutter.cut(above.text);
    if (cells.size() < header.width || header.line != above.line + 1) return;
    for (RowBlock& block : header.blocks) {
        if (block.about.empty()) block.about = unescaped(cells[block.first_value]);
    }
}

std::optional<FoundHeader> header_among(const TopLines& top) {
    for (std::size_t i = 0; i < top.rows.size(); ++i) {
        const std::span<const Row> below = std::span(top.rows).subspan(i + 1);
        std::optional<RowHeader> header =
            row_header_in(top.rows[i].text, top.rows[i].line, below.empty() ? 0 : width_of(top.rows[i], below.front()));
        if (header && i > 0) take_line_above(*header, top.rows[i - 1]);
        if (header && i > 0) {  // a line of prose may look like one
            CellCutter cutter(header->separator);
            if (below.empty() || cutter.cut(below.front().text).size() != header->width) header.reset();
        }
        if (header) return FoundHeader{.header = std::move(*header), .below = below};
        if (i > 0 && starts_like_a_number(trimmed(top.rows[i].text))) break;
    }
    if (!top.comment || top.rows.empty()) return std::nullopt;
    std::optional<RowHeader> header = row_header_in(top.comment->text, top.comment->line);
    if (!header) return std::nullopt;
    CellCutter cutter(header->separator);
    if (cutter.cut(top.rows.front().text).size() != header->width) return std::nullopt;
    return FoundHeader{.header = std::move(*header), .below = top.rows};
}

}  // namespace

std::optional<RowHeader> row_header_in(std::string_view line, std::size_t number, std::size_t row_width) {
    constexpr std::size_t fewest = 3;
    if (line.size() > longest_line_bytes) return std::nullopt;
    RowHeader header{.line = number, .separator = separator_of(line)};
    CellCutter cutter(header.separator);
    const std::span<const std::string_view> all = cutter.cut(line);
    const std::size_t named_width = filled_width(all);
    const std::size_t shift = row_width == named_width + 1 && wavelength_named(all.front(), false) ? 1 : 0;
    header.width = named_width + shift;
    std::map<std::size_t, std::string> labels;
    if (shift > 0) labels[0] = {};
    std::string unit;
    std::optional<WavelengthName> last;
    for (std::size_t i = 0; i < named_width; ++i) {
        const std::optional<WavelengthName> named = wavelength_named(all[i], header.separator != ',');
        if (!named || (!unit.empty() && named->unit != unit)) {
            labels[i + shift] = unescaped(all[i]);
            last = std::nullopt;
            continue;
        }
        const bool goes_on = last && named->about == last->about && named->number != header.blocks.back().numbers[0];
        if (!goes_on) header.blocks.push_back({.first_value = i + shift, .about = named->about});
        header.blocks.back().numbers.push_back(named->number);
        if (unit.empty()) unit = named->unit;
        last = named;
    }
    // Too few wavelengths to be any, or other numbers.
    const Abscissa by_unit = unit.empty() ? Abscissa{} : abscissa_stated(unit).value_or(Abscissa{});
    std::erase_if(header.blocks, [&](const RowBlock& block) {
        const bool few = block.numbers.size() < fewest;
        const bool whole = header.blocks.size() == 1 && !few;  // judged below, with what the labels state
        if (whole || (!few && are_mostly_wavelengths(wavelengths_nm(by_unit, block.numbers)))) return false;
        for (std::size_t i = 0; i < block.numbers.size(); ++i) {
            labels[block.first_value + i] = unescaped(all[block.first_value + i - shift]);
        }
        return true;
    });
    for (auto& [cell, label] : labels) {
        header.label.push_back(cell);
        header.labels.push_back(std::move(label));
    }
    if (header.label.empty() || header.label.front() != 0 || header.blocks.empty()) return std::nullopt;
    if (!unit.empty()) header.abscissa = abscissa_stated(unit);
    for (const std::size_t before :
         {header.blocks.front().first_value, std::size_t{1}}) {  // the label at the numbers, then the corner
        if (header.abscissa || before == 0 || before > header.labels.size()) continue;
        header.abscissa = abscissa_in_corner(header.labels[before - 1]);
    }
    const bool usable = !header.abscissa || header.abscissa->unusable.empty();
    const bool may_be_names = corner_speaks_of_wavelengths(header) || is_nameless(header.labels.front());
    const bool known = usable && std::ranges::all_of(header.blocks, [&](const RowBlock& block) {
                           const std::vector<double> nm = header.wavelength_nm(block);
                           return may_be_names ? are_wavelengths(nm) : are_mostly_wavelengths(nm);
                       });
    return known ? std::optional(header) : std::nullopt;
}

std::optional<RowHeader> find_row_header(std::string_view text) {
    const TopLines top = top_lines(text);
    std::optional<FoundHeader> found = header_among(top);
    if (!found) return std::nullopt;
    const std::optional<double> ratio = range_ratio(found->header, found->below);
    if (ratio && *ratio < clearly_wider) return std::nullopt;
    return std::move(found->header);
}

void refuse_two_axes(std::string_view text, const std::string& source) {
    const TopLines top = top_lines(text);
    const std::optional<FoundHeader> found = header_among(top);
    if (!found) return;
    const std::optional<double> ratio = range_ratio(found->header, found->below);
    if (!ratio || *ratio >= clearly_wider || *ratio <= 1 / clearly_wider) return;
    const std::vector<double> nm = found->header.wavelength_nm();
    throw InputError(
        {.where = fmt::format("{}:{}", source, found->header.line),
         .problem = fmt::format("the header runs from {} to {}, and the first column may be wavelengths too",
                                nm.front(), nm.back()),
         .why = "the spectra stand in rows or in columns, and nothing tells in which",
         .remedy = "use --reader rows or --reader columns"});
}

}  // namespace skinfit
