#include "measurements/row_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/limits.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The name of a column taken apart: `R_400nm` is `r`, 400, `nm`.
struct NumberName {
    std::string prefix;
    double number;
    std::string suffix;
};

std::string_view without_marks(std::string_view text) {
    const auto is_mark = [](char c) { return contains(" _-.()[]:=@", {&c, 1}); };
    while (!text.empty() && is_mark(text.back())) text.remove_suffix(1);
    while (!text.empty() && is_mark(text.front())) text.remove_prefix(1);
    return text;
}

/// Known prefixes only: `subject 401` is no wavelength.
std::optional<NumberName> number_name(std::string_view name) {
    static constexpr std::array<std::string_view, 29> prefixes = {"",
                                                                  "spec",
                                                                  "spectral",
                                                                  "spectral_nm",
                                                                  "nm",
                                                                  "wl",
                                                                  "wv",
                                                                  "wvl",
                                                                  "w",
                                                                  "wave",
                                                                  "wavelength",
                                                                  "lambda",
                                                                  "l",
                                                                  "x",
                                                                  "r",
                                                                  "refl",
                                                                  "reflectance",
                                                                  "rfl",
                                                                  "rho",
                                                                  "%r",
                                                                  "t",
                                                                  "trans",
                                                                  "transmittance",
                                                                  "%t",
                                                                  "a",
                                                                  "abs",
                                                                  "absorbance",
                                                                  "wavelength_nm",
                                                                  "lambda_nm"};
    static constexpr std::array<std::string_view, 6> suffixes = {"", "nm", "um", "cm-1", "1/cm", "thz"};
    const std::string plain = plain_text(name);
    const std::size_t begin = plain.find_first_of("0123456789");
    if (begin == std::string::npos) return std::nullopt;
    const std::size_t end = std::min(plain.find_first_not_of("0123456789.", begin), plain.size());
    std::string_view digits = std::string_view(plain).substr(begin, end - begin);
    if (digits.ends_with('.')) digits.remove_suffix(1);
    const std::optional<double> number = parse_number(digits);
    NumberName found{.prefix = std::string(without_marks(std::string_view(plain).substr(0, begin))),
                     .number = number.value_or(0),
                     .suffix = std::string(without_marks(std::string_view(plain).substr(end)))};
    const bool known = std::ranges::find(prefixes, found.prefix) != prefixes.end() &&
                       std::ranges::find(suffixes, found.suffix) != suffixes.end();
    return known && number && std::isfinite(*number) ? std::optional(found) : std::nullopt;
}

char separator_of(std::string_view line) {
    constexpr std::array marks = {',', ';', '\t'};
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
    const std::optional<Abscissa> corner = abscissa_stated(header.labels.front());
    if (numbers.empty() || !corner || !corner->unusable.empty()) return 0;
    const std::vector<double> nm = wavelengths_nm(*corner, numbers);
    return are_wavelengths(nm) ? std::abs(nm.back() - nm.front()) : 0;
}

bool corner_speaks_of_wavelengths(const RowHeader& header) {
    return is_abscissa_name(header.labels.front());
}

/// Where the corner speaks of wavelengths, how much wider the range of the header is than that of the first column.
std::optional<double> range_ratio(const RowHeader& header, std::span<const Row> below) {
    if (!corner_speaks_of_wavelengths(header)) return std::nullopt;
    const std::vector<double> nm = header.wavelength_nm();
    const double along = std::abs(nm.back() - nm.front());
    const double down = span_of_first_column(header, below);
    return down > 0 ? along / down : HUGE_VAL;
}

struct FoundHeader {
    RowHeader header;
    std::span<const Row> below;
};

std::optional<FoundHeader> header_among(const TopLines& top) {
    for (std::size_t i = 0; i < top.rows.size(); ++i) {
        const std::span<const Row> below = std::span(top.rows).subspan(i + 1);
        std::optional<RowHeader> header = row_header_in(top.rows[i].text, top.rows[i].line);
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

constexpr double clearly_wider = 2;  // chosen: names of specimens seldom span half as much as a spectrum

}  // namespace

std::optional<RowHeader> row_header_in(std::string_view line, std::size_t number) {
    constexpr std::size_t fewest = 3;
    if (line.size() > longest_line_bytes) return std::nullopt;
    RowHeader header{.line = number, .separator = separator_of(line)};
    CellCutter cutter(header.separator);
    const std::span<const std::string_view> all = cutter.cut(line);
    header.width = filled_width(all);
    std::optional<NumberName> first;
    for (std::size_t i = 0; i < header.width; ++i) {
        const std::optional<NumberName> named = number_name(all[i]);
        const bool goes_on = first && header.first_value + header.numbers.size() == i;
        const bool fits =
            named && (!first || (goes_on && named->prefix == first->prefix && named->suffix == first->suffix));
        if (!fits) {
            header.label.push_back(i);
            header.labels.push_back(unescaped(all[i]));
            continue;
        }
        if (!first) {
            first = named;
            header.first_value = i;
        }
        header.numbers.push_back(named->number);
    }
    if (header.label.empty() || header.label.front() != 0 || header.numbers.size() < fewest) return std::nullopt;
    if (!first->suffix.empty()) header.abscissa = abscissa_stated(first->suffix);
    for (const std::size_t before :
         {header.first_value, std::size_t{1}}) {  // the label at the numbers, then the corner
        if (header.abscissa || before == 0 || before > header.labels.size()) continue;
        header.abscissa = abscissa_in_corner(header.labels[before - 1]);
    }
    header.states = values_stated_by_letter(first->prefix == "a" ? "A" : first->prefix);  // `a400` is no name
    if (header.states.is_empty()) header.states = values_stated_wholly(header.labels.front());
    const bool usable = !header.abscissa || header.abscissa->unusable.empty();
    return usable && are_wavelengths(header.wavelength_nm()) ? std::optional(header) : std::nullopt;
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
