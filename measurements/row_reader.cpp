#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/header.hpp"
#include "measurements/readers.hpp"
#include "measurements/row_blocks.hpp"
#include "measurements/row_header.hpp"
#include "measurements/row_uncertainties.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

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
        decimal_comma_ = has_decimal_commas(header, rows_);
        blocks_ = value_blocks(header, source, statements_);
    }

    std::vector<Spectrum> read() {
        std::vector<ReadRow> rows = read_rows();
        check_declared_numbers(rows);
        for (ReadRow& row : rows) {
            for (double& value : row.values) value *= statements_.factor;
        }
        take_out_zero_bands(rows, blocks_);
        take_uncertainty_rows(rows);
        tell_names_apart(rows);
        const std::string percent_in = row_in_percent(rows);
        std::vector<Spectrum> spectra;
        for (ReadRow& row : rows) {
            UnitStatements unit = unit_statements(row);
            unit.percent_in = percent_in;
            std::ranges::move(doubts_about_scans(statements_.scans, blocks_[row.block].grid.wavelength_nm),
                              std::back_inserter(row.spectrum.remarks));
            take_readings(row.spectrum, blocks_[row.block].grid, {.value = row.values, .sigma = row.sigma}, unit);
            if (!row.spectrum.value.empty()) spectra.push_back(std::move(row.spectrum));
        }
        return spectra;
    }

private:
    /// What the file declares of a single spectrum, or of the wavelengths of several.
    void check_declared_numbers(const std::vector<ReadRow>& rows) const {
        const std::vector<Declared> declared =
            rows.size() > 1 ? declared_of_several(statements_.declared) : statements_.declared;
        const bool sole = rows.size() == 1 && statements_.factor == 1;
        check_declared(source_, declared, header_.blocks.front().numbers,
                       sole ? rows.front().values : std::vector<double>{}, rows.size());
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
            if (i == 0 && take_units(cells)) continue;
            for (std::size_t b = 0; b < blocks_.size(); ++b) {
                if (!blocks_[b].uncertainty) rows.push_back(read_row(cells, rows_[i].line, b));
            }
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

    /// A row of units below the header, as `%` under every wavelength.
    bool take_units(std::span<const std::string_view> cells) {
        for (ValueBlock& block : blocks_) {
            const auto units = cells.subspan(block.cells.first_value, block.cells.numbers.size());
            const bool all_units = std::ranges::all_of(
                units, [](std::string_view cell) { return is_unit(cell) && !parse_number(cell) && !is_missing(cell); });
            if (!all_units) return false;
            const ValueStatement stated = values_stated(units.front());
            if (stated.unit) block.states.unit = stated.unit;
            if (!stated.unusable.empty()) block.states.unusable = stated.unusable;
        }
        return true;
    }

    /// The numbers of a block in one row.
    std::vector<double> read_values(std::span<const std::string_view> cells, std::size_t line,
                                    const ValueBlock& block) const {
        std::vector<double> values;
        const std::vector<double> nm = header_.wavelength_nm(block.cells);
        for (const std::size_t i : block.used) {
            const std::string_view cell = cells[block.cells.first_value + i];
            const std::optional<double> number = parse_cell(cell, decimal_comma_);
            const bool usable = number && std::isfinite(*number);
            if (!usable && !is_missing(cell) && options_.window.contains(nm[i])) {
                refuse_cell(fmt::format("{}:{}", source_, line), fmt::format("the value at {} nm", nm[i]), cell,
                            decimal_comma_);
            }
            values.push_back(usable ? *number : std::numeric_limits<double>::quiet_NaN());
        }
        return values;
    }

    ReadRow read_row(std::span<const std::string_view> cells, std::size_t line, std::size_t b) const {
        ReadRow row{.spectrum = spectrum_of(description_), .block = b};
        Spectrum& spectrum = row.spectrum;
        spectrum.source = source_;
        spectrum.line = line;
        spectrum.remarks = statements_.remarks;
        row.values = read_values(cells, line, blocks_[b]);
        if (const auto fill = take_out_fill_numbers(row.values, statements_.fill)) {
            spectrum.remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
        }
        for (const ValueBlock& block : blocks_) {
            if (!block.uncertainty || !block.uncertainty->is_standard || block.owner != b || !row.sigma.empty())
                continue;
            row.sigma = read_values(cells, line, block);
            for (double& each : row.sigma) each *= statements_.factor;
            spectrum.sigma_source = fmt::format("given by the file as {}", block.cells.about);
        }
        take_labels(row, cells, line);
        const std::string& about = blocks_[b].cells.about;
        if (has_several_values()) spectrum.name += " " + (about.empty() ? std::to_string(b + 1) : about);
        return row;
    }

    [[nodiscard]] bool has_several_values() const {
        return std::ranges::count_if(blocks_, [](const ValueBlock& block) { return !block.uncertainty; }) > 1;
    }

    /// The label that names the spectra: the first, but for row numbers without a name before another one.
    [[nodiscard]] std::size_t name_label() const {
        const std::string first = lower_case(header_.labels.front());
        return header_.labels.size() > 1 && (first.empty() || first.starts_with("unnamed")) ? 1 : 0;
    }

    /// The spectrum's name and what else the cells beside its values say.
    void take_labels(ReadRow& row, std::span<const std::string_view> cells, std::size_t line) const {
        Spectrum& spectrum = row.spectrum;
        const std::size_t named_by = name_label();
        const std::string_view name = cells[header_.label[named_by]];
        spectrum.name = name.empty() ? fmt::format("line {}", line) : unescaped(name);
        if (!spectrum.quantity) spectrum.quantity = statements_.values.quantity;
        if (!spectrum.geometry.specular) spectrum.geometry.specular = statements_.specular;
        const ValueBlock& block = blocks_[row.block];
        if (block.specular) spectrum.geometry.specular = block.specular;
        ValueStatement stated = block.states;
        const ValueStatement by_name = values_stated(spectrum.name);
        if (by_name.quantity || !by_name.unusable.empty()) stated = by_name;
        if (const auto specular = specular_stated(spectrum.name)) spectrum.geometry.specular = specular;
        row.unit = by_name.unit;
        for (std::size_t i = 0; i < header_.labels.size(); ++i) {
            const std::string_view cell = cells[header_.label[i]];
            if (cell.empty() || i <= named_by) continue;
            const std::string value = unescaped(cell);
            spectrum.notes.push_back({.line = line, .key = header_.labels[i], .value = value});
            if (names_statistics(header_.labels[i])) row.statistic = value;
            const ValueStatement label = values_stated_under(header_.labels[i], value);
            const auto specular = specular_stated(header_.labels[i], value);
            if (label.quantity || !label.unusable.empty()) stated = label;
            if (label.unit) row.unit = label.unit;
            if (specular) spectrum.geometry.specular = specular;
            if (label.quantity || specular || !label.unusable.empty()) row.told_apart += " " + value;
        }
        if (stated.quantity) name_quantity(spectrum, *stated.quantity);
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
        if (!named) named = blocks_[row.block].states.unit;
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
            if (shows_percent(used_values(options_.window, blocks_[row.block].grid, row.values)))
                return row.spectrum.name;
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
    std::vector<ValueBlock> blocks_{};
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
