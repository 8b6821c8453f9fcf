#include "measurements/cgats_statements.hpp"

#include <fmt/format.h>

#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::optional<Quantity> quantity_of(const CgatsTable& table, const CgatsBands& bands) {
    if (bands.quantity) return bands.quantity;
    for (const std::string_view name : {"MEAS_TYPE", "MEASUREMENT_TYPE", "MEASUREMENT_MODE", "SPECTRAL_TYPE"}) {
        if (const auto named = quantity_in_title(table.keyword(name))) return named;
    }
    return std::nullopt;
}

/// By the keywords; of the specular state also by the labels of the set, `cells`, and the names of its fields.
Geometry geometry_of(const CgatsTable& table, const CgatsBands& bands, std::span<const CgatsToken> cells) {
    Geometry geometry;
    for (const auto& [name, keyword] : table.keywords) {
        if (name.find("GEOM") == std::string::npos && name.find("SPECULAR") == std::string::npos) continue;
        const StatedGeometry stated = geometry_in_title(name + " " + keyword.value);
        if (stated.incidence_deg) geometry.incidence_deg = stated.incidence_deg;
        if (stated.specular) geometry.specular = stated.specular;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (parse_number(cells[i].text)) continue;
        const auto stated = specular_in_title(fmt::format("{} {}", table.fields[i].text, cells[i].text));
        if (stated) geometry.specular = stated;
    }
    if (const auto stated = specular_in_title(bands.prefix)) geometry.specular = stated;
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
    for (const std::string_view name : {"MEAS_TYPE", "MEASUREMENT_TYPE", "MEASUREMENT_MODE", "SPECTRAL_TYPE",
                                        "SPECTRAL_UNIT", "SPECTRAL_UNITS", "DATA_TYPE", "DEVICE_CLASS"}) {
        const auto found = table.keywords.find(name);
        if (found == table.keywords.end()) continue;
        const std::string value = lower_case(found->second.value);
        const bool shines = value.starts_with("display") || value.starts_with("ambient") || value.starts_with("emiss");
        const std::optional<std::string> other =
            shines ? std::optional<std::string>("emission") : unusable_quantity(value);
        if (!other) continue;
        refuse_cgats(source, found->second.line, fmt::format("{} is {}", name, in_quotes(found->second.value)),
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
