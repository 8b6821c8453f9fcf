#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/readers.hpp"
#include "measurements/row_header.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// One row: its spectrum without numbers, and these.
struct ReadRow {
    Spectrum spectrum;
    std::vector<double> values;  ///< NaN where one is missing
    std::optional<Unit> unit;    ///< that its labels state
    std::string told_apart;      ///< what its labels state of quantity and specular
};

/// A text of rows taken apart.
class RowReader {
public:
    RowReader(const Lines& lines, const RowHeader& header, const std::string& source, const ReadOptions& options)
        : header_(header), source_(source), options_(options) {
        std::vector<Comment> prose;
        for (const Row& row : lines.rows) {
            if (row.line < header.line) prose.push_back({.line = row.line, .text = trimmed(row.text)});
            if (row.line > header.line) rows_.push_back(row);
        }
        std::vector<Comment> comments = lines.comments;
        std::erase_if(comments, [&](const Comment& comment) { return comment.line == header.line; });
        description_ = read_description(source, comments);
        const std::vector<FileNote> notes = notes_in(prose);
        description_.notes.insert(description_.notes.end(), notes.begin(), notes.end());
        statements_ = statements_in(source, comments, prose);
        decimal_comma_ = header.separator != ',' && header.separator != ' ' &&
                         std::ranges::any_of(rows_, [](const Row& row) { return contains(row.text, ","); });
        take_grid();
    }

    std::vector<Spectrum> read() {
        std::vector<ReadRow> rows = read_rows();
        tell_names_apart(rows);
        const std::string percent_in = row_in_percent(rows);
        std::vector<Spectrum> spectra;
        for (ReadRow& row : rows) {
            UnitStatements unit = unit_statements(row);
            unit.percent_in = percent_in;
            for (double& value : row.values) value *= statements_.factor;
            take_readings(row.spectrum, grid_, {.value = row.values}, unit);
            if (!row.spectrum.value.empty()) spectra.push_back(std::move(row.spectrum));
        }
        return spectra;
    }

private:
    void take_grid() {
        RowHeader header = header_;
        if (!header.abscissa) header.abscissa = statements_.abscissa;
        if (header.abscissa) {
            refuse_unusable(*header.abscissa, fmt::format("{}:{}", source_, header.line));
            if (!header.abscissa->is_nm()) {
                statements_.remarks.push_back(fmt::format("{} to {} {} are read as wavelengths in vacuum",
                                                          header.numbers.front(), header.numbers.back(),
                                                          header.abscissa->name));
            }
        }
        grid_ = make_grid(header.wavelength_nm(), [&](std::size_t i) {
            return GridPlace{.where = fmt::format("{}:{}", source_, header.line),
                             .which = fmt::format("value {}", i + 1)};
        });
    }

    std::vector<ReadRow> read_rows() {
        std::vector<ReadRow> rows;
        CellCutter cutter(header_.separator);
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const std::span<const std::string_view> cells = cutter.cut(rows_[i].text);
            if (filled_width(cells) == 0) continue;
            if (is_log_from(i, cells)) {
                for (ReadRow& row : rows) {
                    row.spectrum.remarks.push_back(
                        fmt::format("what follows the spectra, from line {} on, is taken as a log", rows_[i].line));
                }
                break;
            }
            check_width(cells, rows_[i]);
            rows.push_back(read_row(cells, rows_[i].line));
        }
        return rows;
    }

    /// Below an empty line, lines of other lengths than the header has are no spectra.
    [[nodiscard]] bool is_log_from(std::size_t i, std::span<const std::string_view> cells) const {
        if (i == 0 || rows_[i].line == rows_[i - 1].line + 1 || cells.size() == header_.width) return false;
        return filled_width(cells) * 2 < header_.width;
    }

    void check_width(std::span<const std::string_view> cells, const Row& row) const {
        const std::size_t found = cells.size() < header_.width ? cells.size() : filled_width(cells);
        if (cells.size() >= header_.width && found <= header_.width) return;
        throw InputError({.where = fmt::format("{}:{}", source_, row.line),
                          .problem = fmt::format("has {} field{}", found, found == 1 ? "" : "s"),
                          .why = fmt::format("line {} has {}", header_.line, header_.width),
                          .remedy = "give every spectrum one field per name and wavelength of the header"});
    }

    ReadRow read_row(std::span<const std::string_view> cells, std::size_t line) const {
        ReadRow row{.spectrum = spectrum_of(description_), .values = {}, .unit = {}, .told_apart = {}};
        Spectrum& spectrum = row.spectrum;
        spectrum.source = source_;
        spectrum.line = line;
        spectrum.remarks = statements_.remarks;
        for (std::size_t i = 0; i < header_.numbers.size(); ++i) {
            const std::string_view cell = cells[header_.first_value + i];
            const std::optional<double> number = parse_cell(cell, decimal_comma_);
            const bool usable = number && std::isfinite(*number);
            if (!usable && !is_missing(cell)) {
                refuse_cell(fmt::format("{}:{}", source_, line),
                            fmt::format("the value at {} nm", header_.wavelength_nm()[i]), cell, decimal_comma_);
            }
            row.values.push_back(usable ? *number : std::numeric_limits<double>::quiet_NaN());
        }
        if (const auto fill = take_out_fill_numbers(row.values)) {
            spectrum.remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
        }
        take_labels(row, cells, line);
        return row;
    }

    /// The spectrum's name and what else the cells beside its values say.
    void take_labels(ReadRow& row, std::span<const std::string_view> cells, std::size_t line) const {
        Spectrum& spectrum = row.spectrum;
        spectrum.name = cells.front().empty() ? fmt::format("line {}", line) : unescaped(cells.front());
        if (!spectrum.quantity) spectrum.quantity = statements_.values.quantity;
        if (!spectrum.geometry.specular) spectrum.geometry.specular = statements_.specular;
        ValueStatement stated = header_.states;
        const ValueStatement by_name = values_stated(spectrum.name);
        if (by_name.quantity || !by_name.unusable.empty()) stated = by_name;
        if (const auto specular = specular_stated(spectrum.name)) spectrum.geometry.specular = specular;
        row.unit = by_name.unit;
        for (std::size_t i = 0; i < header_.labels.size(); ++i) {
            const std::string_view cell = cells[header_.label[i]];
            if (cell.empty() || header_.label[i] == 0) continue;
            const std::string value = unescaped(cell);
            spectrum.notes.push_back({.line = line, .key = header_.labels[i], .value = value});
            const ValueStatement label = values_stated_under(header_.labels[i], value);
            const auto specular = specular_stated(header_.labels[i], value);
            if (label.quantity || !label.unusable.empty()) stated = label;
            if (label.unit) row.unit = label.unit;
            if (specular) spectrum.geometry.specular = specular;
            if (label.quantity || specular || !label.unusable.empty()) row.told_apart += " " + value;
        }
        if (stated.quantity) spectrum.quantity = stated.quantity;
        if (stated.unusable.empty() && !stated.quantity) stated.unusable = statements_.values.unusable;
        if (!stated.unusable.empty()) {
            spectrum.unusable = fmt::format("{} is neither reflectance nor transmittance as fraction or percent",
                                            in_quotes(stated.unusable));
        }
    }

    /// Rows of one name get what their labels state beside it: `forearm 1 SCE`.
    static void tell_names_apart(std::vector<ReadRow>& rows) {
        std::map<std::string, std::size_t> count;
        for (const ReadRow& row : rows) ++count[row.spectrum.name];
        for (ReadRow& row : rows) {
            if (count[row.spectrum.name] > 1) row.spectrum.name += row.told_apart;
        }
    }

    [[nodiscard]] UnitStatements unit_statements(const ReadRow& row) const {
        std::optional<Unit> named = row.unit ? row.unit : values_stated(header_.labels.front()).unit;
        if (!named) named = header_.states.unit;
        if (!named) named = statements_.values.unit;
        return {.option = options_.unit, .comment = description_.unit, .named = named, .window = options_.window};
    }

    /// The name of the first spectrum whose values in the window show that the table is in percent, where no word
    /// states it; else empty.
    [[nodiscard]] std::string row_in_percent(const std::vector<ReadRow>& rows) const {
        for (const ReadRow& row : rows) {
            if (!row.spectrum.unusable.empty()) continue;
            const UnitStatements stated = unit_statements(row);
            if (stated.option || stated.comment) return {};
            if (stated.named) continue;
            if (shows_percent(used_values(options_.window, grid_, row.values))) return row.spectrum.name;
        }
        return {};
    }

    const RowHeader& header_;
    const std::string& source_;
    const ReadOptions& options_;
    std::vector<Row> rows_{};
    Description description_{};
    FileStatements statements_{};
    bool decimal_comma_ = false;
    Grid grid_{};
};

}  // namespace

bool holds_spectra_in_rows(std::string_view text) {
    return find_row_header(text).has_value();
}

std::vector<Spectrum> read_rows(std::string_view text, const std::string& source, const ReadOptions& options) {
    const Lines lines = split_comments(text, source);
    std::optional<RowHeader> header = find_row_header(text);
    // Whoever asks for rows gets them, whatever the corner says.
    if (!header && !lines.rows.empty()) header = row_header_in(lines.rows.front().text, lines.rows.front().line);
    const bool has_rows = header && !lines.rows.empty() && lines.rows.back().line > header->line;
    if (!has_rows) {
        throw InputError({.where = source,
                          .problem = header ? "holds no numbers" : "has no header of wavelengths",
                          .why = "the first line names the cells: an id, then at least three wavelengths in nm",
                          .remedy = "check that the file is complete, or choose another --reader"});
    }
    return RowReader(lines, *header, source, options).read();
}

}  // namespace skinfit
