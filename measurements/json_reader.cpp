#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/json_object.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// Names with a meaning; any other is a note.
constexpr std::array<std::string_view, 22> known = {
    "name",         "wavelength_nm", "start",          "step",
    "value",        "values",        "sigma",          "unit",
    "quantity",     "incidence_deg", "specular",       "viewing_cone_deg",
    "instrument",   "site",          "aperture_mm",    "repeats",
    "sigma_source", "missing_nm",    "bandpass_shape", "bandpass_width_nm",
    "notes",        "missing"};

/// `wavelength_nm`, or as many as there are values from `start` on by `step`.
std::vector<double> wavelengths(const JsonObject& object, std::size_t count) {
    if (object.find("wavelength_nm") != nullptr) return numbers(object, "wavelength_nm", count);
    const std::optional<double> start = number(object, "start", {0, wavelength_range_nm.highest});
    const std::optional<double> step =
        number(object, "step", {-wavelength_range_nm.highest, wavelength_range_nm.highest});
    if (!start || !step) {
        throw InputError({.where = object.where,
                          .problem = "has no wavelengths",
                          .why = "wavelength_nm, or start and step in nm, give them",
                          .remedy = fmt::format("add them; {}", json_example)});
    }
    std::vector<double> found;
    for (std::size_t i = 0; i < count; ++i) found.push_back(*start + *step * static_cast<double>(i));
    return found;
}

/// `notes`, a list of pairs, and all names without a meaning of their own.
void take_notes(Spectrum& spectrum, const JsonObject& object) {
    if (const Json* const notes = object.find("notes"); notes != nullptr) {
        for (const Json& note : *notes) {
            const bool is_pair = note.is_array() && note.size() == 2 && note[0].is_string() && note[1].is_string();
            if (!is_pair) refuse_json(object, "notes", *notes, "a list of pairs of texts is needed");
            spectrum.notes.push_back(
                {.line = 0, .key = note[0].get<std::string>(), .value = note[1].get<std::string>()});
        }
    }
    for (const auto& [name, value] : object.json.items()) {
        if (std::ranges::find(known, name) != known.end()) continue;
        if (const auto meant = similar_name(lower_case(name), known)) {
            throw InputError({.where = object.where,
                              .problem = fmt::format("unknown name {}", in_quotes(name)),
                              .why = "it would have no effect",
                              .remedy = fmt::format("did you mean \"{}\"? Else rename it", *meant)});
        }
        spectrum.notes.push_back(
            {.line = 0, .key = name, .value = value.is_string() ? value.get<std::string>() : shown(value)});
    }
}

/// What names without a meaning of their own state, as comments of text files do.
FileStatements statements_of(const JsonObject& object) {
    std::vector<std::string> texts;
    for (const auto& [name, value] : object.json.items()) {
        if (std::ranges::find(known, name) != known.end() || !(value.is_string() || value.is_number())) continue;
        texts.push_back(fmt::format("{}: {}", name, value.is_string() ? value.get<std::string>() : value.dump()));
    }
    std::vector<Comment> comments;
    for (const std::string& each : texts) comments.push_back({.line = 0, .text = each});
    return statements_in(object.where, comments, {});
}

void take_description(Spectrum& spectrum, const JsonObject& object) {
    spectrum.quantity = word<Quantity>(object, "quantity", quantity_names);
    spectrum.geometry.incidence_deg = number(object, "incidence_deg", incidence_range_deg);
    spectrum.geometry.specular = word<Specular>(object, "specular", specular_names);
    spectrum.geometry.viewing_cone_deg = number(object, "viewing_cone_deg", viewing_cone_range_deg);
    spectrum.instrument = text(object, "instrument");
    spectrum.site = text(object, "site");
    spectrum.aperture_mm = positive(object, "aperture_mm");
    const auto shape = word<BandpassShape>(object, "bandpass_shape", bandpass_shape_names);
    const std::optional<double> width_nm = positive(object, "bandpass_width_nm", bandpass_width_range_nm.highest);
    if (shape.has_value() != width_nm.has_value()) {
        throw InputError({.where = object.where,
                          .problem = fmt::format("gives bandpass_{} alone", shape ? "shape" : "width_nm"),
                          .why = "a bandpass is a shape and a width",
                          .remedy = fmt::format("add bandpass_{}", shape ? "width_nm" : "shape")});
    }
    if (shape) spectrum.bandpass = {.shape = *shape, .width_nm = *width_nm};
    take_notes(spectrum, object);
}

/// The readings of the same specimen, in the order of the grid, without the wavelengths whose value is missing; NaN
/// where a reading has none.
void take_repeats(Spectrum& spectrum, const JsonObject& object, const Grid& grid, const std::vector<double>& value,
                  double scale) {
    const Json* const repeats = object.find("repeats");
    if (repeats == nullptr) return;
    if (!repeats->is_array()) refuse_json(object, "repeats", *repeats, "a list of lists of numbers is needed");
    for (const Json& repeat : *repeats) {
        const std::vector<double> found = numbers(object, "repeats", repeat);
        if (found.size() != value.size()) {
            refuse_json(object, "repeats", repeat,
                        fmt::format("it has {} numbers for {} wavelengths", found.size(), value.size()));
        }
        std::vector<double>& readings = spectrum.repeats.emplace_back();
        for (const std::size_t i : grid.order) {
            if (std::isnan(value[i])) continue;
            readings.push_back(found[i] / scale);
        }
    }
}

/// `percent_in` is another spectrum of the list that is in percent; empty where none is.
Spectrum spectrum_of(const JsonObject& object, const std::string& source, const std::string& default_name,
                     const ReadOptions& options, const std::string& percent_in = {}) {
    if (!object.json.is_object()) {
        throw InputError({.where = object.where,
                          .problem = fmt::format("{} is no object", shown(object.json)),
                          .why = "a spectrum has names and values",
                          .remedy = fmt::format("correct it; {}", json_example)});
    }
    const std::string_view values_name = object.find("values") != nullptr ? "values" : "value";
    const Json* const values = object.find(values_name);
    if (values == nullptr || (object.find("values") != nullptr && object.find("value") != nullptr)) {
        throw InputError({.where = object.where,
                          .problem = values == nullptr ? "has no values" : "has both value and values",
                          .why = "one list of numbers is needed, called value or values",
                          .remedy = fmt::format("correct it; {}", json_example)});
    }
    const FileStatements statements = statements_of(object);
    std::vector<double> value = numbers(object, values_name, *values);
    std::vector<double> sigma = numbers(object, "sigma", value.size());
    const std::optional<double> fill = take_out_fill_numbers(value);
    for (double& each : value) each *= statements.factor;
    for (double& each : sigma) each *= statements.factor;
    const Abscissa abscissa = statements.abscissa.value_or(Abscissa{});
    refuse_unusable(abscissa, object.where);
    const Grid grid = make_grid(wavelengths_nm(abscissa, wavelengths(object, value.size())), [&](std::size_t i) {
        return GridPlace{.where = object.where, .which = fmt::format("number {}", i + 1)};
    });
    Spectrum spectrum;
    spectrum.source = source;
    spectrum.name = text(object, "name");
    if (spectrum.name.empty()) spectrum.name = default_name;
    take_description(spectrum, object);
    if (!spectrum.quantity) spectrum.quantity = statements.values.quantity;
    if (!spectrum.geometry.specular) spectrum.geometry.specular = statements.specular;
    if (!spectrum.quantity && !statements.values.unusable.empty()) {
        spectrum.unusable =
            fmt::format("{} is neither reflectance nor transmittance", in_quotes(statements.values.unusable));
    }
    spectrum.remarks = statements.remarks;
    if (fill) spectrum.remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
    take_readings(spectrum, grid, {.value = value, .sigma = sigma},
                  {.option = options.unit,
                   .comment = word<Unit>(object, "unit", unit_names),
                   .named = statements.values.unit,
                   .percent_in = percent_in,
                   .window = options.window});
    take_repeats(spectrum, object, grid, value, spectrum.unit_rule.starts_with("percent") ? 100 : 1);
    // Release 0.1.0 wrote how many there were, and not where.
    spectrum.missing_nm.resize(
        spectrum.missing_nm.size() + static_cast<std::size_t>(number(object, "missing", {0, 1e6}).value_or(0)),
        std::numeric_limits<double>::quiet_NaN());
    if (const Json* const missing = object.find("missing_nm"); missing != nullptr) {
        std::ranges::move(numbers(object, "missing_nm", *missing), std::back_inserter(spectrum.missing_nm));
    }
    if (!sigma.empty()) {
        spectrum.sigma_source = text(object, "sigma_source");
        if (spectrum.sigma_source.empty()) spectrum.sigma_source = "given by the file";
    }
    return spectrum;
}

/// The wavelength of value `i` of an object that has not been checked; NaN where it is not told.
double glance_at_wavelength(const Json& spectrum, std::size_t i) {
    const auto number_in = [](const Json& json) {
        return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
    };
    const Json nothing;
    const auto part = [&](const char* name) -> const Json& {
        const auto found = spectrum.find(name);
        return found == spectrum.end() ? nothing : *found;
    };
    const Json& list = part("wavelength_nm");
    if (list.is_array()) return i < list.size() ? number_in(list[i]) : std::numeric_limits<double>::quiet_NaN();
    return number_in(part("start")) + static_cast<double>(i) * number_in(part("step"));
}

/// The first spectrum of a list that is in percent, as it states or as its values in the window show; empty where none
/// is.
std::string spectrum_in_percent(const Json& all, const WavelengthWindow& window) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Json& json = all[i];
        if (!json.is_object()) continue;
        const std::string name = json.contains("name") && json["name"].is_string() ? json["name"].get<std::string>()
                                                                                   : fmt::format("spectrum {}", i + 1);
        if (json.contains("unit")) {
            if (json["unit"] == "percent") return name;
            continue;
        }
        const auto list = json.contains("value") ? json.find("value") : json.find("values");
        if (list == json.end() || !list->is_array()) continue;
        std::vector<double> values;
        std::vector<double> wavelength_nm;
        for (const Json& value : *list) {
            wavelength_nm.push_back(glance_at_wavelength(json, values.size()));
            const bool is_reading = value.is_number() && !is_fill_number(value.get<double>());
            values.push_back(is_reading ? value.get<double>() : std::numeric_limits<double>::quiet_NaN());
        }
        if (shows_percent(used_values(window, wavelength_nm, values))) return name;
    }
    return {};
}

}  // namespace

bool holds_json(std::string_view text) {
    const std::string_view content = trimmed(text);
    if (content.starts_with('{')) return true;
    if (!content.starts_with('[')) return false;
    // A title in brackets, as [Measurement], is no list.
    const std::string_view first = trimmed(content.substr(1));
    return first.empty() || std::string_view("{[]\"-0123456789").find(first.front()) != std::string_view::npos ||
           first.starts_with("null") || first.starts_with("true") || first.starts_with("false");
}

std::vector<Spectrum> read_json(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    const Json file = parsed_json(text, source, std::string(json_example));
    const bool ours = file.is_object() && file.contains("spectra");
    const Json& all = ours ? file["spectra"] : file;
    const std::string stem = std::filesystem::path(source).stem().string();
    if (!all.is_array()) return {spectrum_of({.json = all, .where = source}, source, stem, options)};
    const std::string percent_in = spectrum_in_percent(all, options.window);
    std::vector<Spectrum> spectra;
    for (const Json& json : all) {
        const std::string number = fmt::format("spectrum {}", spectra.size() + 1);
        spectra.push_back(spectrum_of({.json = json, .where = fmt::format("{}: {}", source, number)}, source, number,
                                      options, percent_in));
    }
    std::erase_if(spectra, [](const Spectrum& spectrum) { return spectrum.value.empty(); });
    return spectra;
}

}  // namespace skinfit
