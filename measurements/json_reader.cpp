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
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

constexpr std::string_view example = "`skinfit convert --format json` writes an example";

/// Names with a meaning; any other is a note.
constexpr std::array<std::string_view, 22> known = {
    "name",         "wavelength_nm", "start",          "step",
    "value",        "values",        "sigma",          "unit",
    "quantity",     "incidence_deg", "specular",       "viewing_cone_deg",
    "instrument",   "site",          "aperture_mm",    "repeats",
    "sigma_source", "missing_nm",    "bandpass_shape", "bandpass_width_nm",
    "notes",        "missing"};

/// One object of the file, and how messages name it.
struct Object {
    const Json& json;
    std::string where;

    [[nodiscard]] const Json* find(std::string_view name) const {
        const auto found = json.find(name);
        return found == json.end() || found->is_null() ? nullptr : &*found;
    }
};

[[noreturn]] void refuse(const Object& object, std::string_view name, const Json& value, const std::string& why) {
    throw InputError({.where = fmt::format("{}: {}", object.where, name),
                      .problem = fmt::format("{} cannot be used", shown(value)),
                      .why = why,
                      .remedy = fmt::format("correct it; {}", example)});
}

std::optional<double> number(const Object& object, std::string_view name, const Range& range) {
    const Json* const value = object.find(name);
    if (value == nullptr) return std::nullopt;
    const double found = value->is_number() ? value->get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!range.contains(found)) {
        refuse(object, name, *value, fmt::format("a number from {} to {} is needed", range.lowest, range.highest));
    }
    return found;
}

std::string text(const Object& object, std::string_view name) {
    const Json* const value = object.find(name);
    if (value == nullptr) return {};
    if (!value->is_string()) refuse(object, name, *value, "text is needed");
    return value->get<std::string>();
}

template <typename Meaning, std::size_t size>
std::optional<Meaning> word(const Object& object, std::string_view name,
                            const std::array<std::string_view, size>& words) {
    const Json* const value = object.find(name);
    if (value == nullptr) return std::nullopt;
    const auto found = std::ranges::find(words, lower_case(text(object, name)));
    if (found == words.end()) {
        refuse(object, name, *value, fmt::format("it must be {}", fmt::join(words, " or ")));
    }
    return static_cast<Meaning>(found - words.begin());
}

/// NaN stands for null.
std::vector<double> numbers(const Object& object, std::string_view name, const Json& array) {
    if (!array.is_array() || array.empty()) refuse(object, name, array, "a list of numbers is needed");
    std::vector<double> found;
    found.reserve(array.size());
    for (const Json& element : array) {
        if (!element.is_number() && !element.is_null()) refuse(object, name, element, "a number or null is needed");
        found.push_back(element.is_null() ? std::numeric_limits<double>::quiet_NaN() : element.get<double>());
    }
    return found;
}

std::vector<double> numbers(const Object& object, std::string_view name, std::size_t count) {
    const Json* const array = object.find(name);
    if (array == nullptr) return {};
    std::vector<double> found = numbers(object, name, *array);
    if (found.size() == count) return found;
    refuse(object, name, *array, fmt::format("it has {} numbers for {} wavelengths", found.size(), count));
}

std::optional<double> positive(const Object& object, std::string_view name,
                               double upto = std::numeric_limits<double>::infinity()) {
    const Json* const value = object.find(name);
    if (value == nullptr) return std::nullopt;
    const double found = value->is_number() ? value->get<double>() : 0.0;
    if (!(found > 0.0 && found <= upto)) {
        const std::string most = std::isfinite(upto) ? fmt::format(" and at most {}", upto) : "";
        refuse(object, name, *value, fmt::format("a number above 0{} is needed", most));
    }
    return found;
}

/// `wavelength_nm`, or as many as there are values from `start` on by `step`.
std::vector<double> wavelengths(const Object& object, std::size_t count) {
    if (object.find("wavelength_nm") != nullptr) return numbers(object, "wavelength_nm", count);
    const std::optional<double> start = number(object, "start", {0, wavelength_range_nm.highest});
    const std::optional<double> step =
        number(object, "step", {-wavelength_range_nm.highest, wavelength_range_nm.highest});
    if (!start || !step) {
        throw InputError({.where = object.where,
                          .problem = "has no wavelengths",
                          .why = "wavelength_nm, or start and step in nm, give them",
                          .remedy = fmt::format("add them; {}", example)});
    }
    std::vector<double> found;
    for (std::size_t i = 0; i < count; ++i) found.push_back(*start + *step * static_cast<double>(i));
    return found;
}

/// `notes`, a list of pairs, and all names without a meaning of their own.
void take_notes(Spectrum& spectrum, const Object& object) {
    if (const Json* const notes = object.find("notes"); notes != nullptr) {
        for (const Json& note : *notes) {
            const bool is_pair = note.is_array() && note.size() == 2 && note[0].is_string() && note[1].is_string();
            if (!is_pair) refuse(object, "notes", *notes, "a list of pairs of texts is needed");
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

void take_description(Spectrum& spectrum, const Object& object) {
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
void take_repeats(Spectrum& spectrum, const Object& object, const Grid& grid, const std::vector<double>& value,
                  double scale) {
    const Json* const repeats = object.find("repeats");
    if (repeats == nullptr) return;
    if (!repeats->is_array()) refuse(object, "repeats", *repeats, "a list of lists of numbers is needed");
    for (const Json& repeat : *repeats) {
        const std::vector<double> found = numbers(object, "repeats", repeat);
        if (found.size() != value.size()) {
            refuse(object, "repeats", repeat,
                   fmt::format("it has {} numbers for {} wavelengths", found.size(), value.size()));
        }
        std::vector<double>& readings = spectrum.repeats.emplace_back();
        for (const std::size_t i : grid.order) {
            if (std::isnan(value[i])) continue;
            readings.push_back(found[i] / scale);
        }
    }
}

Spectrum spectrum_of(const Object& object, const std::string& source, const std::string& default_name,
                     const ReadOptions& options) {
    if (!object.json.is_object()) {
        throw InputError({.where = object.where,
                          .problem = fmt::format("{} is no object", shown(object.json)),
                          .why = "a spectrum has names and values",
                          .remedy = fmt::format("correct it; {}", example)});
    }
    const std::string_view values_name = object.find("values") != nullptr ? "values" : "value";
    const Json* const values = object.find(values_name);
    if (values == nullptr || (object.find("values") != nullptr && object.find("value") != nullptr)) {
        throw InputError({.where = object.where,
                          .problem = values == nullptr ? "has no values" : "has both value and values",
                          .why = "one list of numbers is needed, called value or values",
                          .remedy = fmt::format("correct it; {}", example)});
    }
    const std::vector<double> value = numbers(object, values_name, *values);
    const std::vector<double> sigma = numbers(object, "sigma", value.size());
    const Grid grid = make_grid(wavelengths(object, value.size()), [&](std::size_t i) {
        return GridPlace{.where = object.where, .which = fmt::format("number {}", i + 1)};
    });
    Spectrum spectrum;
    spectrum.source = source;
    spectrum.name = text(object, "name");
    if (spectrum.name.empty()) spectrum.name = default_name;
    take_description(spectrum, object);
    take_readings(spectrum, grid, {.value = value, .sigma = sigma},
                  {.option = options.unit,
                   .comment = word<Unit>(object, "unit", unit_names),
                   .header = {},
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

}  // namespace

bool holds_json(std::string_view text) {
    const std::string_view content = trimmed(text);
    return content.starts_with('{') || content.starts_with('[');
}

std::vector<Spectrum> read_json(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    const Json file = parsed_json(text, source, std::string(example));
    const bool ours = file.is_object() && file.contains("spectra");
    const Json& all = ours ? file["spectra"] : file;
    const std::string stem = std::filesystem::path(source).stem().string();
    if (!all.is_array()) return {spectrum_of({.json = all, .where = source}, source, stem, options)};
    std::vector<Spectrum> spectra;
    for (const Json& json : all) {
        const std::string number = fmt::format("spectrum {}", spectra.size() + 1);
        spectra.push_back(
            spectrum_of({.json = json, .where = fmt::format("{}: {}", source, number)}, source, number, options));
    }
    std::erase_if(spectra, [](const Spectrum& spectrum) { return spectrum.value.empty(); });
    return spectra;
}

}  // namespace skinfit
