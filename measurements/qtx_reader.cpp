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
#include "measurements/cells.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/left_out.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The value of a key, and where it stands.
struct QtxValue {
    std::size_t line;
    std::string_view text;
};

/// `[STANDARD_DATA 0]` or `[BATCH_DATA 0]` with the keys below it, in capitals and without their prefix.
struct QtxSection {
    std::size_t line;
    std::string_view title;
    std::map<std::string, QtxValue, std::less<>> values{};

    [[nodiscard]] std::string_view text(std::string_view key) const {
        const auto found = values.find(key);
        return found == values.end() ? std::string_view{} : found->second.text;
    }
    [[nodiscard]] std::size_t line_of(std::string_view key) const {
        const auto found = values.find(key);
        return found == values.end() ? line : found->second.line;
    }
};

std::string capitals(std::string_view text) {
    std::string upper(text);
    for (char& c : upper) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return upper;
}

/// `STD_` of a standard, `BAT_` of a batch; empty for other sections.
std::string_view prefix_of(std::string_view title) {
    const std::string upper = capitals(title);
    if (upper.starts_with("[STANDARD") || upper.starts_with("[STD")) return "STD_";
    if (upper.starts_with("[BATCH") || upper.starts_with("[BAT") || upper.starts_with("[TRIAL")) return "BAT_";
    return {};
}

/// Without the comma that some programs put behind every value.
std::string_view without_end_comma(std::string_view value) {
    return value.ends_with(',') || value.ends_with(';') ? trimmed(value.substr(0, value.size() - 1)) : value;
}

std::vector<QtxSection> sections_in(std::string_view text, const std::string& source) {
    std::vector<QtxSection> sections;
    std::size_t number = 0;
    LineReader reader(text);
    while (const auto whole = reader.next()) {
        ++number;
        refuse_long_line(whole->size(), number, source);
        const std::string_view line = trimmed(*whole);
        if (line.starts_with('[')) sections.push_back({.line = number, .title = line});
        const std::size_t mark = line.find_first_of("=,");
        if (line.starts_with('[') || mark == std::string_view::npos || sections.empty()) continue;
        const std::string_view prefix = prefix_of(sections.back().title);
        const std::string key = capitals(trimmed(line.substr(0, mark)));
        if (prefix.empty() || !key.starts_with(prefix)) continue;
        const auto [place, is_new] = sections.back().values.emplace(
            key.substr(prefix.size()),
            QtxValue{.line = number, .text = without_end_comma(trimmed(line.substr(mark + 1)))});
        if (is_new) continue;
        throw InputError({.where = fmt::format("{}:{}", source, number),
                          .problem = fmt::format("gives {} again", in_quotes(key)),
                          .why = fmt::format("line {} gives it already", place->second.line),
                          .remedy = "keep one of the two"});
    }
    return sections;
}

[[noreturn]] void refuse(const QtxSection& section, std::string_view key, const std::string& source,
                         const std::string& problem, const std::string& why) {
    throw InputError({.where = fmt::format("{}:{}", source, section.line_of(key)),
                      .problem = problem,
                      .why = why,
                      .remedy = "check that the file is complete and unchanged"});
}

double number(const QtxSection& section, std::string_view key, const std::string& source) {
    const std::optional<double> found = parse_number(section.text(key));
    if (!found || !std::isfinite(*found)) {
        refuse(section, key, source, fmt::format("{} is {}", key, in_quotes(section.text(key))), "a number is needed");
    }
    return *found;
}

/// The readings as written; NaN where one is missing.
std::vector<double> readings(const QtxSection& section, const std::string& source) {
    std::vector<double> values;
    const std::string_view text = section.text("R");
    const bool semicolons = text.find(';') != std::string_view::npos;  // then a comma is a decimal mark
    for (const std::string_view cell : split(text, semicolons ? ';' : ',')) {
        std::string digits(cell);
        if (semicolons) std::ranges::replace(digits, ',', '.');
        const std::optional<double> value = parse_number(digits);
        if (is_missing(cell) || value == 0.0) {  // no surface reflects nothing
            values.push_back(std::numeric_limits<double>::quiet_NaN());
        } else if (value && std::isfinite(*value)) {
            values.push_back(*value);
        } else {
            refuse(section, "R", source, fmt::format("holds {} among its readings", in_quotes(cell)),
                   "a number is needed");
        }
    }
    const double promised = section.values.contains("REFLPOINTS") ? number(section, "REFLPOINTS", source)
                                                                  : static_cast<double>(values.size());
    if (static_cast<double>(values.size()) == promised) return values;
    refuse(section, "R", source, fmt::format("holds {} readings", values.size()),
           fmt::format("REFLPOINTS promises {}", promised));
}

/// Keys that say what the readings are, as SPECTYPE, MODE or UNITS.
bool is_of_values(std::string_view key) {
    return is_ordinate_key(key) || contains(key, "TYPE") || contains(key, "MODE") || contains(key, "UNIT");
}

/// VIEWING and the like say `SCI`, `Specular Included` or `d/8`; a yes to a key SPECULAR is an answer too.
Geometry geometry_of(const QtxSection& section, std::string_view name) {
    Geometry geometry{.incidence_deg = std::nullopt, .specular = specular_stated(name), .viewing_cone_deg = {}};
    for (const auto& [key, value] : section.values) {
        const bool viewing =
            contains(key, "VIEW") || contains(key, "SPEC") || contains(key, "GEOM") || is_of_values(key);
        if (!viewing) continue;
        const StatedGeometry stated = geometry_stated(key, value.text);
        if (stated.incidence_deg) geometry.incidence_deg = stated.incidence_deg;
        if (stated.specular) geometry.specular = stated.specular;
    }
    return geometry;
}

/// The quantity of the readings: reflectance, unless the section says otherwise. Throws InputError where it is none.
Quantity quantity_of(const QtxSection& section, const std::string& source) {
    Quantity quantity = Quantity::reflectance;
    for (const auto& [key, value] : section.values) {
        if (!is_of_values(key)) continue;
        const ValueStatement stated = values_stated_by_letter(value.text);
        if (stated.quantity) quantity = *stated.quantity;
        if (stated.unusable.empty()) continue;
        throw InputError({.where = fmt::format("{}:{}", source, value.line),
                          .problem = fmt::format("{} is {}", key, in_quotes(value.text)),
                          .why = fmt::format("{} is no reflectance or transmittance", value.text),
                          .remedy = remedy_for(value.text)});
    }
    return quantity;
}

/// Scales that the form does not know, and readings that are percent by the form and can hardly be.
void take_doubts(Spectrum& spectrum, const QtxSection& section, std::span<const double> values) {
    for (const auto& [key, value] : section.values) {
        const bool scales = contains(key, "SCALE") || contains(key, "FACTOR") || contains(key, "MULTIPL");
        const double number = parse_number(value.text).value_or(1);
        if (!scales || number == 1 || number == 100) continue;
        spectrum.doubts.push_back({.message = fmt::format("line {}, {} = {}, is not understood and not applied",
                                                          value.line, key, in_quotes(value.text)),
                                   .remedy = "apply it to the readings and delete the line, or delete it"});
    }
    if (!std::ranges::all_of(values, [](double value) { return std::isnan(value) || value <= largest_fraction; }))
        return;
    spectrum.doubts.push_back({.message = "readings of QTX files are percent, and none of these exceeds 1.5",
                               .remedy = "if they are fractions, give --unit fraction"});
}

Spectrum spectrum_of(const QtxSection& section, const std::string& source, const ReadOptions& options) {
    const Quantity quantity = quantity_of(section, source);
    std::vector<double> values = readings(section, source);
    const std::optional<double> fill = take_out_fill_numbers(values);
    const double low = number(section, "REFLLOW", source);
    const double interval = number(section, "REFLINTERVAL", source);
    std::vector<double> wavelength_nm;
    for (std::size_t i = 0; i < values.size(); ++i) wavelength_nm.push_back(low + interval * static_cast<double>(i));
    const Grid grid = make_grid(wavelength_nm, [&](std::size_t i) {
        return GridPlace{.where = fmt::format("{}:{}", source, section.line_of("REFLLOW")),
                         .which = fmt::format("reading {}", i + 1)};
    });
    Spectrum spectrum;
    spectrum.name = std::string(section.text("NAME"));
    if (spectrum.name.empty()) spectrum.name = std::string(section.title);
    spectrum.source = source;
    spectrum.line = section.line;
    spectrum.quantity = quantity;
    spectrum.geometry = geometry_of(section, spectrum.name);
    spectrum.instrument = std::string(section.text("INSTRUMENT"));
    if (fill) spectrum.remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
    if (!options.unit) take_doubts(spectrum, section, values);
    if (options.unit) {
        take_readings(spectrum, grid, {.value = values}, {.option = options.unit, .comment = {}, .header = {}});
    } else {
        take_readings(spectrum, grid, {.value = values},
                      UnitFinding{.unit = Unit::percent, .rule = "percent: as QTX files have it"});
    }
    return spectrum;
}

}  // namespace

bool holds_qtx(std::string_view text) {
    LineReader reader(text);
    while (const auto line = reader.next()) {
        const std::string_view content = trimmed(*line);
        if (!content.starts_with('[')) continue;
        if (!prefix_of(content).empty() && content.ends_with(']')) return true;
        return false;
    }
    return false;
}

std::vector<Spectrum> read_qtx(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    refuse_binary(text, source);
    std::vector<Spectrum> spectra;
    LeftOut left_out;
    for (const QtxSection& section : sections_in(text, source)) {
        if (section.text("R").empty()) continue;
        left_out.or_keep_error([&] { spectra.push_back(spectrum_of(section, source, options)); });
        if (!spectra.empty() && spectra.back().value.empty()) spectra.pop_back();
    }
    left_out.tell(spectra);
    if (spectra.empty()) {
        throw InputError({.where = source,
                          .problem = "holds no spectra",
                          .why = "no section [STANDARD_DATA ...] or [BATCH_DATA ...] has readings in STD_R= or BAT_R=",
                          .remedy = "export the measurement with its reflectances"});
    }
    return spectra;
}

}  // namespace skinfit
