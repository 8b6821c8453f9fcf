#include "fit/named_instrument.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "core/embedded_file.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/json_reading.hpp"
#include "fit/settings.hpp"

namespace skinfit {

namespace instrument_files {
std::span<const EmbeddedFile> embedded_files();
}  // namespace instrument_files

namespace {

const std::string example = "configs/instruments, which comes with skinfit, has examples";

std::string stem(const EmbeddedFile& file) {
    return std::string(file.name.substr(0, file.name.rfind('.')));
}

const std::vector<std::string_view> keys = {"description",      "incidence_deg", "specular",
                                            "viewing_cone_deg", "aperture_mm",   "bandpass",
                                            "wavelength_nm",    "noise",         "sources"};

/// An object with exactly the keys `known`.
void require_keys(const Json& json, const std::vector<std::string_view>& known, const std::string& where) {
    require_names(json, known, {known, "an instrument states it, or null where it is not known", example}, where);
}

/// What is stated needs its source.
void require_sources(const Json& json, const std::string& where) {
    require_object(json["sources"], where + ".sources", example);
    for (const std::string_view key : keys) {
        if (key == "description" || key == "sources" || json[key].is_null() || json["sources"].contains(key)) continue;
        throw InputError({.where = where + ".sources",
                          .problem = fmt::format("no \"{}\"", key),
                          .why = "what is stated needs a source",
                          .remedy = "say where it is from, or state null"});
    }
}

std::optional<double> number_of(const Json& json, const char* key, const Range& range, const std::string& where) {
    if (json[key].is_null()) return std::nullopt;
    return read_number(json[key], range, where + "." + key);
}

std::optional<Bandpass> bandpass_of(const Json& json, const std::string& where) {
    if (json.is_null()) return std::nullopt;
    require_keys(json, {"shape", "width_nm"}, where);
    return Bandpass{
        .shape = static_cast<BandpassShape>(read_choice(json["shape"], bandpass_shape_names, where + ".shape")),
        .width_nm = read_number(json["width_nm"], bandpass_width_range_nm, where + ".width_nm")};
}

Geometry geometry_of(const Json& json, const std::string& where) {
    Geometry geometry{.incidence_deg = number_of(json, "incidence_deg", incidence_range_deg, where),
                      .viewing_cone_deg = number_of(json, "viewing_cone_deg", viewing_cone_range_deg, where)};
    if (!json["specular"].is_null()) {
        geometry.specular = static_cast<Specular>(read_choice(json["specular"], specular_names, where + ".specular"));
    }
    return geometry;
}

}  // namespace

std::vector<std::string> instrument_names() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : instrument_files::embedded_files()) names.push_back(stem(file));
    return names;
}

NamedInstrument find_instrument(const std::string& name_or_file, const std::string& where) {
    for (const EmbeddedFile& file : instrument_files::embedded_files()) {
        if (stem(file) != name_or_file) continue;
        NamedInstrument instrument = parse_instrument(file.text, std::string(file.name));
        instrument.name = name_or_file;
        return instrument;
    }
    std::error_code error;
    const std::filesystem::file_status found = std::filesystem::status(name_or_file, error);
    if (std::filesystem::is_regular_file(found) || std::filesystem::is_fifo(found)) {
        return parse_instrument(read_input(name_or_file), name_or_file);
    }
    throw InputError({.where = where,
                      .problem = fmt::format("there is no instrument \"{}\"", name_or_file),
                      .why = "it is neither a file nor one of those that come with the program",
                      .remedy = fmt::format("give a JSON file, or one of {}", fmt::join(instrument_names(), ", "))});
}

NamedInstrument parse_instrument(std::string_view text, const std::string& source) {
    const Json json = parsed_json(text, source, example);
    require_keys(json, keys, source);
    require_sources(json, source);
    if (!json["description"].is_string()) {
        refuse(source + ".description", json["description"], "text is needed", example);
    }
    NamedInstrument instrument{.name = source,
                               .description = json["description"].get<std::string>(),
                               .geometry = geometry_of(json, source),
                               .aperture_mm = number_of(json, "aperture_mm", {0.01, 1000}, source),
                               .bandpass = bandpass_of(json["bandpass"], source + ".bandpass"),
                               .noise = number_of(json, "noise", noise_range, source)};
    if (const Json& grid = json["wavelength_nm"]; !grid.is_null()) {
        const std::string where = source + ".wavelength_nm";
        require_keys(grid, {"first", "last", "step"}, where);
        instrument.first_nm = number_of(grid, "first", wavelength_range_nm, where);
        instrument.last_nm = number_of(grid, "last", wavelength_range_nm, where);
        instrument.step_nm = number_of(grid, "step", {1e-3, 1000}, where);
    }
    return instrument;
}

}  // namespace skinfit
