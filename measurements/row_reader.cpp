#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The wavelength that a column's name states: `360`, `360 nm`, `nm360` or `SPEC_360`.
std::optional<double> wavelength_named(std::string_view name) {
    const std::string text = lower_case(name);
    std::string_view number = text;
    for (const std::string_view prefix : {"spec_", "nm_", "nm"}) {
        if (!number.starts_with(prefix)) continue;
        number.remove_prefix(prefix.size());
        break;
    }
    if (number.ends_with("nm")) number.remove_suffix(2);
    const std::optional<double> wavelength_nm = parse_number(trimmed(number));
    return wavelength_nm && wavelength_range_nm.contains(*wavelength_nm) ? wavelength_nm : std::nullopt;
}

/// The first line of a table with a spectrum in each row.
struct RowHeader {
    char separator;
    std::vector<std::string> labels;  ///< of the cells before the values; at least one, the first names the spectrum
    std::vector<double> wavelength_nm;
};

/// The header, if this line is one: labels, then at least three wavelengths that ascend or descend. A first label that
/// speaks of wavelengths makes the numbers names of columns.
std::optional<RowHeader> row_header(std::string_view line) {
    constexpr std::size_t fewest = 3;
    if (line.size() > longest_line_bytes) return std::nullopt;
    constexpr std::array marks = {',', ';', '\t'};
    const auto most = std::ranges::max_element(marks, {}, [line](char c) { return std::ranges::count(line, c); });
    const char separator = line.find(*most) == std::string_view::npos ? ' ' : *most;
    CellCutter cutter(separator);
    const std::span<const std::string_view> all = cutter.cut(line);
    const std::span<const std::string_view> cells = all.first(filled_width(all));
    RowHeader header{.separator = separator, .labels = {}, .wavelength_nm = {}};
    for (const std::string_view cell : cells) {
        const std::optional<double> wavelength_nm = wavelength_named(cell);
        if (wavelength_nm) {
            header.wavelength_nm.push_back(*wavelength_nm);
        } else if (header.wavelength_nm.empty()) {
            header.labels.push_back(unescaped(cell));
        } else {
            return std::nullopt;
        }
    }
    if (header.labels.empty() || header.wavelength_nm.size() < fewest) return std::nullopt;
    const std::string first = lower_case(header.labels.front());
    if (first.find("wave") != std::string::npos || first.find("nm") != std::string::npos) return std::nullopt;
    const auto& nm = header.wavelength_nm;
    const bool ascends = std::ranges::adjacent_find(nm, std::ranges::greater_equal{}) == nm.end();
    const bool descends = std::ranges::adjacent_find(nm, std::ranges::less_equal{}) == nm.end();
    return ascends || descends ? std::optional(header) : std::nullopt;
}

/// The first line that is neither empty nor a comment.
std::string_view first_content(std::string_view text) {
    LineReader reader(text);
    while (const auto line = reader.next()) {
        const std::string_view content = trimmed(*line);
        if (!content.empty() && content.front() != '#') return *line;
    }
    return {};
}

/// The values of one row; NaN where one is missing.
std::vector<double> values_in(std::span<const std::string_view> cells, const RowHeader& header, bool decimal_comma,
                              const std::string& source, std::size_t line) {
    std::vector<double> values;
    values.reserve(header.wavelength_nm.size());
    for (std::size_t i = 0; i < header.wavelength_nm.size(); ++i) {
        const std::string_view cell = cells[header.labels.size() + i];
        const std::optional<double> number = parse_cell(cell, decimal_comma);
        const bool usable = number && std::isfinite(*number);
        if (!usable && !is_missing(cell)) {
            refuse_cell(fmt::format("{}:{}", source, line), fmt::format("the value at {} nm", header.wavelength_nm[i]),
                        cell, decimal_comma);
        }
        values.push_back(usable ? *number : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
}

void check_width(std::span<const std::string_view> cells, const RowHeader& header, const Row& row,
                 const std::string& source, std::size_t header_line) {
    const std::size_t width = header.labels.size() + header.wavelength_nm.size();
    const std::size_t found = cells.size() < width ? cells.size() : filled_width(cells);
    if (cells.size() >= width && found <= width) return;
    throw InputError({.where = fmt::format("{}:{}", source, row.line),
                      .problem = fmt::format("has {} field{}", found, found == 1 ? "" : "s"),
                      .why = fmt::format("line {} has {}", header_line, width),
                      .remedy = "give every spectrum one field per name and wavelength of the header"});
}

/// The spectrum's name and what else the cells before its values say.
void take_labels(Spectrum& spectrum, std::span<const std::string_view> cells, const RowHeader& header,
                 std::size_t line) {
    spectrum.name = cells.front().empty() ? fmt::format("line {}", line) : unescaped(cells.front());
    spectrum.line = line;
    for (std::size_t i = 1; i < header.labels.size(); ++i) {
        if (cells[i].empty()) continue;
        spectrum.notes.push_back({.line = line, .key = header.labels[i], .value = unescaped(cells[i])});
    }
}

}  // namespace

bool holds_spectra_in_rows(std::string_view text) {
    return row_header(first_content(text)).has_value();
}

std::vector<Spectrum> read_rows(std::string_view text, const std::string& source, const ReadOptions& options) {
    const Lines lines = split_comments(text, source);
    const std::optional<RowHeader> header = lines.rows.empty() ? std::nullopt : row_header(lines.rows.front().text);
    if (!header || lines.rows.size() < 2) {
        throw InputError({.where = source,
                          .problem = header ? "holds no numbers" : "has no header of wavelengths",
                          .why = "the first line names the cells: an id, then at least three wavelengths in nm",
                          .remedy = "check that the file is complete, or choose another --reader"});
    }
    const Description description = read_description(source, lines.comments);
    const std::size_t header_line = lines.rows.front().line;
    const Grid grid = make_grid(header->wavelength_nm, [&](std::size_t i) {
        return GridPlace{.where = fmt::format("{}:{}", source, header_line), .which = fmt::format("value {}", i + 1)};
    });
    const bool decimal_comma =
        header->separator != ',' && header->separator != ' ' &&
        std::ranges::any_of(lines.rows, [](const Row& row) { return row.text.find(',') != std::string_view::npos; });
    std::vector<Spectrum> spectra;
    CellCutter cutter(header->separator);
    for (const Row& row : std::span(lines.rows).subspan(1)) {
        const std::span<const std::string_view> cells = cutter.cut(row.text);
        if (filled_width(cells) == 0) continue;
        check_width(cells, *header, row, source, header_line);
        const std::vector<double> values = values_in(cells, *header, decimal_comma, source, row.line);
        Spectrum spectrum = spectrum_of(description);
        spectrum.source = source;
        take_labels(spectrum, cells, *header, row.line);
        take_readings(spectrum, grid, {.value = values},
                      {.option = options.unit,
                       .comment = description.unit,
                       .header = header->labels.front(),
                       .window = options.window});
        if (!spectrum.value.empty()) spectra.push_back(std::move(spectrum));
    }
    return spectra;
}

}  // namespace skinfit
