#include "measurements/cgats_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// Keywords that say what the values are.
bool is_of_values(std::string_view name) {
    static constexpr std::array<std::string_view, 6> names = {"MEAS_TYPE",     "MEASUREMENT_MODE", "SPECTRAL_TYPE",
                                                              "SPECTRAL_UNIT", "SPECTRAL_UNITS",   "DEVICE_CLASS"};
    return is_ordinate_key(name) || std::ranges::find(names, name) != names.end();
}

std::optional<Quantity> quantity_of(const CgatsTable& table, const CgatsBands& bands) {
    if (bands.quantity) return bands.quantity;
    for (const auto& [name, keyword] : table.keywords) {
        if (!is_of_values(name)) continue;
        if (const auto named = values_stated_by_letter(keyword.value).quantity) return named;
    }
    return std::nullopt;
}

/// By the keywords; of the specular state also by the labels of the set, `cells`, and the names of its fields.
Geometry geometry_of(const CgatsTable& table, const CgatsBands& bands, std::span<const CgatsToken> cells) {
    Geometry geometry;
    for (const auto& [name, keyword] : table.keywords) {
        if (!contains(name, "GEOM") && !contains(name, "SPECULAR") && !is_of_values(name)) continue;
        const StatedGeometry stated = geometry_stated(name, keyword.value);
        if (stated.incidence_deg) geometry.incidence_deg = stated.incidence_deg;
        if (stated.specular) geometry.specular = stated.specular;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (parse_number(cells[i].text)) continue;
        if (const auto stated = specular_stated(table.fields[i].text, cells[i].text)) geometry.specular = stated;
    }
    if (const auto stated = specular_stated(bands.prefix)) geometry.specular = stated;
    return geometry;
}

std::string instrument_of(const CgatsTable& table) {
    for (const std::string_view name : {"TARGET_INSTRUMENT", "INSTRUMENTATION", "INSTRUMENT"}) {
        if (!table.keyword(name).empty()) return std::string(table.keyword(name));
    }
    return {};
}

std::string name_of_set(const CgatsTable& table, std::span<const CgatsToken> cells) {
    for (const std::string_view name : {"SAMPLE_NAME", "SAMPLE_ID", "SAMPLEID", "NAME"}) {
        const std::optional<std::size_t> field = table.field_called(name);
        if (field && !cells[*field].text.empty()) return unescaped(cells[*field].text);
    }
    return {};
}

/// Keywords that say how it was measured.
void take_notes(Spectrum& spectrum, const CgatsTable& table, std::span<const CgatsToken> cells) {
    for (const std::string_view field : {"SAMPLE_TYPE", "SAMPLE_LOC"}) {
        const std::optional<std::size_t> at = table.field_called(field);
        if (!at) continue;
        spectrum.notes.push_back(
            {.line = cells[*at].line, .key = std::string(field), .value = unescaped(cells[*at].text)});
    }
    for (const std::string_view name :
         {"MEASUREMENT_GEOMETRY", "MEASUREMENT_SOURCE", "MEASUREMENT_FILTER", "FILTER", "INSTRUMENTATION"}) {
        const auto found = table.keywords.find(name);
        if (found == table.keywords.end()) continue;
        spectrum.notes.push_back({.line = found->second.line, .key = std::string(name), .value = found->second.value});
        if (name.find("FILTER") == std::string_view::npos || lower_case(found->second.value).find("pol") != 0) continue;
        spectrum.remarks.push_back(
            fmt::format("{} is {}: light was measured through polarising filters, which the model does not know; state "
                        "specular=excluded where they are crossed",
                        name, in_quotes(found->second.value)));
    }
}

}  // namespace

void refuse_other_quantities(const CgatsTable& table, const std::string& source) {
    for (const auto& [name, keyword] : table.keywords) {
        const std::string value = lower_case(keyword.value);
        const bool prose = name == "DESCRIPTOR" || name == "FILE_DESCRIPTOR";
        if (!prose && !is_of_values(name)) continue;
        std::optional<std::string> other;
        if (prose) {
            other = unusable_in_prose(value);
        } else if (value.starts_with("display") || value.starts_with("ambient") || value.starts_with("emiss")) {
            other = "emission";
        } else if (value.starts_with("density") || !values_stated_by_letter(value).unusable.empty()) {
            other = value;
        }
        if (!other) continue;
        refuse_cgats(source, keyword.line, fmt::format("{} is {}", name, in_quotes(keyword.value)),
                     fmt::format("{} is no reflectance or transmittance", *other), remedy_for(*other));
    }
}

Spectrum cgats_statements(const CgatsTable& table, const CgatsBands& bands, std::span<const CgatsToken> cells) {
    Spectrum spectrum;
    spectrum.name = name_of_set(table, cells);
    spectrum.line = cells.front().line;
    spectrum.quantity = quantity_of(table, bands);
    spectrum.geometry = geometry_of(table, bands, cells);
    spectrum.instrument = instrument_of(table);
    spectrum.doubts = bands.doubts;
    take_notes(spectrum, table, cells);
    return spectrum;
}

}  // namespace skinfit
