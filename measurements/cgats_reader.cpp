#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// A word of a table, and where it stands.
struct Token {
    std::size_t line;
    std::string_view text;
};

/// One table of the file: its keywords, the names of its fields and its sets, one after the other.
struct CgatsTable {
    std::map<std::string, Token, std::less<>> keywords;
    std::vector<Token> fields;
    std::vector<Token> cells;

    [[nodiscard]] std::string_view keyword(std::string_view name) const {
        const auto found = keywords.find(name);
        return found == keywords.end() ? std::string_view{} : found->second.text;
    }
    [[nodiscard]] std::optional<double> number(std::string_view name) const { return parse_number(keyword(name)); }
};

[[noreturn]] void refuse(const std::string& source, std::size_t line, const std::string& problem,
                         const std::string& why, const std::string& remedy = "check that the file is complete") {
    throw InputError({.where = line > 0 ? fmt::format("{}:{}", source, line) : source,
                      .problem = problem,
                      .why = why,
                      .remedy = remedy});
}

/// Where the words of a line go.
enum class Section { keywords, fields, data };

std::vector<CgatsTable> tables_in(const Lines& lines, const std::string& source) {
    std::vector<CgatsTable> tables(1);
    Section section = Section::keywords;
    CellCutter cutter(' ');
    for (const Row& row : lines.rows) {
        const std::span<const std::string_view> words = cutter.cut(row.text);
        const std::string_view first = words.front();
        if (first == "BEGIN_DATA_FORMAT") {
            section = Section::fields;
            if (!tables.back().fields.empty()) tables.emplace_back();
        } else if (first == "BEGIN_DATA") {
            section = Section::data;
        } else if (first == "END_DATA_FORMAT") {
            section = Section::keywords;
        } else if (first == "END_DATA") {
            section = Section::keywords;
            tables.emplace_back();
        } else if (section == Section::fields) {
            for (const std::string_view word : words) tables.back().fields.push_back({.line = row.line, .text = word});
        } else if (section == Section::data) {
            for (const std::string_view word : words) tables.back().cells.push_back({.line = row.line, .text = word});
        } else if (words.size() > 1) {
            tables.back().keywords.insert_or_assign(std::string(first), Token{.line = row.line, .text = words[1]});
        }
    }
    if (section != Section::keywords) {
        refuse(source, 0, "ends inside its data", "END_DATA is missing");
    }
    return tables;
}

/// Which fields hold the spectrum, and at which wavelengths.
struct Bands {
    std::vector<std::size_t> field;
    std::vector<double> wavelength_nm;
};

/// Fields are called `SPEC_360`, `NM_360`, `nm360`, `SPECTRAL_NM360` or `SPECTRAL_NM_360`. Argyll rounds the names to
/// whole nanometres; SPECTRAL_START_NM, SPECTRAL_END_NM and SPECTRAL_BANDS, where they agree with them, are exact.
Bands bands_of(const CgatsTable& table) {
    constexpr std::array<std::string_view, 5> prefixes = {"spec_", "spectral_nm_", "spectral_nm", "nm_", "nm"};
    Bands bands;
    for (std::size_t i = 0; i < table.fields.size(); ++i) {
        const std::string name = lower_case(table.fields[i].text);
        const auto prefix =
            std::ranges::find_if(prefixes, [&](std::string_view known) { return name.starts_with(known); });
        if (prefix == prefixes.end()) continue;
        const std::optional<double> nm = parse_number(std::string_view(name).substr(prefix->size()));
        if (!nm) continue;
        bands.field.push_back(i);
        bands.wavelength_nm.push_back(*nm);
    }
    const std::optional<double> start = table.number("SPECTRAL_START_NM");
    const std::optional<double> end = table.number("SPECTRAL_END_NM");
    const std::size_t count = bands.field.size();
    if (!start || !end || count < 2 || table.number("SPECTRAL_BANDS") != static_cast<double>(count)) return bands;
    std::vector<double> exact;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        exact.push_back(*start + (*end - *start) * share);
        if (!(std::abs(exact[i] - bands.wavelength_nm[i]) <= 0.5)) return bands;  // as names are rounded
    }
    bands.wavelength_nm = exact;
    return bands;
}

std::optional<std::size_t> field_called(const CgatsTable& table, std::string_view name) {
    const auto found = std::ranges::find(table.fields, name, &Token::text);
    if (found == table.fields.end()) return std::nullopt;
    return static_cast<std::size_t>(found - table.fields.begin());
}

/// NaN where the value is missing: 0 stands for that, since no surface reflects nothing.
double reading(const Token& cell, std::string_view field, const std::string& source) {
    const std::optional<double> number = parse_number(cell.text);
    if (!number || !std::isfinite(*number)) {
        refuse(source, cell.line, fmt::format("holds {} as {}", in_quotes(cell.text), field), "a number is needed",
               "correct the value, or write 0 for one that is missing");
    }
    return *number == 0 ? std::numeric_limits<double>::quiet_NaN() : *number;
}

/// By SPECTRAL_NORM, the reading of a perfect white; else by the rule for files that state nothing. `readings` are
/// those at all wavelengths, set after set.
UnitFinding unit_of(const CgatsTable& table, const std::vector<double>& readings,
                    const std::vector<double>& wavelength_nm, const ReadOptions& options) {
    const double norm = table.number("SPECTRAL_NORM").value_or(0.0);
    if (options.unit || (norm != 1.0 && norm != 100.0)) {
        std::vector<double> present;
        std::vector<double> used;
        for (std::size_t i = 0; i < readings.size(); ++i) {
            if (std::isnan(readings[i])) continue;
            present.push_back(readings[i]);
            if (options.window.contains(wavelength_nm[i % wavelength_nm.size()])) used.push_back(readings[i]);
        }
        return find_unit({.option = options.unit, .comment = std::nullopt, .header = {}},
                         used.empty() ? present : used);
    }
    const bool percent = norm == 100;
    return {.unit = percent ? Unit::percent : Unit::fraction,
            .rule = fmt::format("{}: stated by SPECTRAL_NORM", percent ? "percent" : "fraction")};
}

std::optional<Quantity> quantity_of(const CgatsTable& table) {
    const std::string type = lower_case(table.keyword("MEAS_TYPE"));
    if (type.starts_with("reflect")) return Quantity::reflectance;
    if (type.starts_with("transmi")) return Quantity::transmittance;
    return std::nullopt;
}

/// Throws InputError where the sets are not as many and as long as they are said to be.
void check_sets(const CgatsTable& table, const std::string& source) {
    const std::size_t width = table.fields.size();
    const std::size_t sets = table.cells.size() / width;
    if (table.cells.size() % width != 0) {
        refuse(source, table.cells.back().line, fmt::format("the last set has {} values", table.cells.size() % width),
               fmt::format("the format names {} fields", width));
    }
    const std::optional<double> promised = table.number("NUMBER_OF_SETS");
    if (!promised || *promised == static_cast<double>(sets)) return;
    refuse(source, 0, fmt::format("holds {} sets", sets), fmt::format("NUMBER_OF_SETS promises {}", *promised));
}

std::vector<Spectrum> spectra_of(const CgatsTable& table, const std::string& source, const ReadOptions& options) {
    const Bands bands = bands_of(table);
    if (bands.field.empty() || table.cells.empty()) return {};
    check_sets(table, source);
    const Grid grid = make_grid(bands.wavelength_nm, [&](std::size_t i) {
        const Token& field = table.fields[bands.field[i]];
        return GridPlace{.where = fmt::format("{}:{}", source, field.line), .which = std::string(field.text)};
    });
    const std::size_t width = table.fields.size();
    std::vector<double> readings;
    for (std::size_t set = 0; set < table.cells.size(); set += width) {
        for (const std::size_t i : bands.field) {
            readings.push_back(reading(table.cells[set + i], table.fields[i].text, source));
        }
    }
    if (std::ranges::all_of(readings, [](double value) { return std::isnan(value); })) return {};
    const UnitFinding unit = unit_of(table, readings, bands.wavelength_nm, options);
    const std::optional<std::size_t> id = field_called(table, "SAMPLE_ID");
    const std::optional<std::size_t> name = field_called(table, "SAMPLE_NAME");

    std::vector<Spectrum> spectra;
    for (std::size_t set = 0; set < table.cells.size() / width; ++set) {
        const std::span<const Token> cells = std::span(table.cells).subspan(set * width, width);
        Spectrum spectrum;
        spectrum.name = name ? unescaped(cells[*name].text)
                        : id ? unescaped(cells[*id].text)
                             : fmt::format("set {}", set + 1);
        spectrum.source = source;
        spectrum.line = cells.front().line;
        spectrum.quantity = quantity_of(table);
        spectrum.instrument = std::string(table.keyword("TARGET_INSTRUMENT"));
        for (const std::string_view field : {"SAMPLE_TYPE", "SAMPLE_LOC"}) {
            const std::optional<std::size_t> at = field_called(table, field);
            if (!at) continue;
            spectrum.notes.push_back(
                {.line = cells[*at].line, .key = std::string(field), .value = unescaped(cells[*at].text)});
        }
        const std::size_t count = bands.field.size();
        take_readings(spectrum, grid, {.value = std::span(readings).subspan(set * count, count)}, unit);
        if (!spectrum.value.empty()) spectra.push_back(std::move(spectrum));
    }
    return spectra;
}

}  // namespace

bool holds_cgats(std::string_view text) {
    LineReader reader(text);
    while (const auto line = reader.next()) {
        const std::string_view content = trimmed(*line);
        if (content == "BEGIN_DATA_FORMAT") return true;
        if (starts_like_a_number(content)) return false;
    }
    return false;
}

std::vector<Spectrum> read_cgats(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    std::vector<Spectrum> spectra;
    for (const CgatsTable& table : tables_in(split_comments(text, source), source)) {
        std::ranges::move(spectra_of(table, source, options), std::back_inserter(spectra));
    }
    if (spectra.empty()) {
        refuse(source, 0, "holds no spectra",
               "no table has fields such as SPEC_360 with numbers in them; it may hold colours only",
               "export the measurement with its spectral values");
    }
    return spectra;
}

}  // namespace skinfit
