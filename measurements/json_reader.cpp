#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "measurements/json_lists.hpp"
#include "measurements/json_object.hpp"
#include "measurements/json_statements.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

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
        const bool is_known = std::ranges::find(json_names, name) != json_names.end();
        if (is_known || is_taken_list(name, value)) continue;
        const auto meant = is_understood(name, value) ? std::nullopt : similar_name(lower_case(name), json_names);
        if (meant) {
            throw InputError({.where = object.where,
                              .problem = fmt::format("unknown name {}", in_quotes(name)),
                              .why = "it would have no effect",
                              .remedy = fmt::format("did you mean \"{}\"? Else rename it", *meant)});
        }
        spectrum.notes.push_back(
            {.line = 0, .key = name, .value = value.is_string() ? value.get<std::string>() : shown(value)});
    }
}

/// The words of `name` where they are none of its own: what they state of the values.
ValueStatement stated_under(const JsonObject& object, std::string_view name) {
    const Json* const value = object.find(name);
    return value != nullptr && value->is_string() ? values_stated_by_letter(value->get<std::string>())
                                                  : ValueStatement{};
}

/// What the values are, in other words than those of `convert` too.
void take_quantity(Spectrum& spectrum, const JsonObject& object, const FileStatements& statements,
                   const std::string& values_name) {
    const ValueStatement stated = stated_under(object, "quantity");
    const ValueStatement by_unit = stated_under(object, "unit");
    std::string unusable = stated.unusable.empty() ? by_unit.unusable : stated.unusable;
    if (unusable.empty() && !stated.quantity) {
        spectrum.quantity = word<Quantity>(object, "quantity", quantity_names);
        for (const ValueStatement& each :
             {by_unit, values_stated_by_letter(values_name), statements.values, values_stated(spectrum.name)}) {
            if (!spectrum.quantity) spectrum.quantity = each.quantity;
        }
        if (!object.find("quantity") && !statements.values.unusable.empty()) unusable = statements.values.unusable;
        if (!spectrum.quantity && unusable.empty()) unusable = unusable_in_prose(spectrum.name).value_or("");
    } else {
        spectrum.quantity = stated.quantity;
    }
    if (!unusable.empty()) {
        spectrum.unusable = fmt::format("{} is neither reflectance nor transmittance", in_quotes(unusable));
    }
}

std::optional<Unit> unit_in(const JsonObject& object) {
    const ValueStatement stated = stated_under(object, "unit");
    if (stated.unit || !stated.unusable.empty() || stated.quantity) return stated.unit;
    return word<Unit>(object, "unit", unit_names);
}

std::optional<Specular> specular_in(const JsonObject& object) {
    const Json* const value = object.find("specular");
    if (value != nullptr && value->is_string()) {
        if (const auto stated = specular_stated("specular", value->get<std::string>())) return stated;
    }
    if (value != nullptr && value->is_boolean()) return value->get<bool>() ? Specular::included : Specular::excluded;
    return word<Specular>(object, "specular", specular_names);
}

void take_description(Spectrum& spectrum, const JsonObject& object) {
    spectrum.geometry.incidence_deg = number(object, "incidence_deg", incidence_range_deg);
    spectrum.geometry.specular = specular_in(object);
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

/// A spectrum before the unit of its file is known.
struct RawSpectrum {
    Spectrum spectrum;
    Grid grid;
    std::vector<double> value;                 ///< as in the file's order, multiplied by its factor; NaN where missing
    std::vector<double> sigma;                 ///< likewise; empty where not given
    std::vector<std::vector<double>> repeats;  ///< likewise
    std::optional<Unit> unit;                  ///< under that name
    std::optional<Unit> named;                 ///< stated otherwise
    std::size_t missing;                       ///< by `missing`
    std::vector<double> missing_nm;            ///< likewise
};

std::vector<std::vector<double>> repeats_in(const JsonObject& object, std::size_t count) {
    const Json* const repeats = object.find("repeats");
    if (repeats == nullptr) return {};
    if (!repeats->is_array()) refuse_json(object, "repeats", *repeats, "a list of lists of numbers is needed");
    std::vector<std::vector<double>> all;
    for (const Json& repeat : *repeats) {
        all.push_back(numbers(object, "repeats", repeat));
        if (all.back().size() == count) continue;
        refuse_json(object, "repeats", repeat,
                    fmt::format("it has {} numbers for {} wavelengths", all.back().size(), count));
    }
    return all;
}

/// Makes NaN of numbers that stand for missing ones, with a remark, and multiplies the others.
void clean(RawSpectrum& raw, std::span<const double> declared, double factor) {
    std::optional<double> fill;
    const auto take = [&](std::vector<double>& values) {
        for (double& value : values) {
            if (std::ranges::find(declared, value) == declared.end()) continue;
            if (!fill) fill = value;
            value = std::numeric_limits<double>::quiet_NaN();
        }
        const std::optional<double> found = take_out_fill_numbers(values);
        if (!fill) fill = found;
        for (double& value : values) value *= factor;
    };
    take(raw.value);
    for (std::vector<double>& repeat : raw.repeats) take(repeat);
    for (double& each : raw.sigma) each *= factor;
    if (fill) raw.spectrum.remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
}

RawSpectrum raw_spectrum(const JsonObject& object, const std::string& source, const std::string& default_name) {
    if (!object.json.is_object()) {
        throw InputError({.where = object.where,
                          .problem = fmt::format("{} is no object", shown(object.json)),
                          .why = "a spectrum has names and values",
                          .remedy = fmt::format("correct it; {}", json_example)});
    }
    const FileStatements statements = statements_in(object);
    const JsonValues values = values_in(object);
    const JsonAbscissa along = abscissa_in(object, values.numbers.size());
    JsonUncertainty uncertainty = uncertainty_in(object, values.numbers.size());
    const Abscissa abscissa = along.stated ? *along.stated : statements.abscissa.value_or(Abscissa{});
    refuse_unusable(abscissa, object.where);
    RawSpectrum raw{
        .spectrum = {},
        .grid = make_grid(
            wavelengths_nm(abscissa, along.numbers),
            [&](std::size_t i) { return GridPlace{.where = object.where, .which = fmt::format("number {}", i + 1)}; }),
        .value = values.numbers,
        .sigma = std::move(uncertainty.sigma),
        .repeats = repeats_in(object, values.numbers.size()),
        .unit = unit_in(object),
        .named = statements.values.unit,
        // Release 0.1.0 wrote how many there were, and not where.
        .missing = static_cast<std::size_t>(number(object, "missing", {0, 1e6}).value_or(0)),
        .missing_nm = {}};
    Spectrum& spectrum = raw.spectrum;
    spectrum.source = source;
    spectrum.name = text(object, "name");
    if (spectrum.name.empty()) spectrum.name = default_name;
    take_description(spectrum, object);
    take_quantity(spectrum, object, statements, values.name);
    if (!spectrum.geometry.specular) spectrum.geometry.specular = statements.specular;
    if (!spectrum.geometry.specular) spectrum.geometry.specular = specular_stated(spectrum.name);
    spectrum.remarks = statements.remarks;
    spectrum.remarks.insert(spectrum.remarks.end(), uncertainty.remarks.begin(), uncertainty.remarks.end());
    spectrum.doubts = contradictions(object, along.numbers);
    if (!abscissa.is_nm()) {
        spectrum.remarks.push_back(fmt::format("the wavelengths are converted from {} to nm", abscissa.name));
    }
    if (!raw.sigma.empty()) {
        spectrum.sigma_source = text(object, "sigma_source");
        if (spectrum.sigma_source.empty()) spectrum.sigma_source = "given by the file";
    }
    if (const Json* const missing = object.find("missing_nm"); missing != nullptr) {
        raw.missing_nm = numbers(object, "missing_nm", *missing);
    }
    clean(raw, missing_values(object), statements.factor);
    return raw;
}

/// The readings of the same specimen, in the order of the grid, without the wavelengths whose value is missing; NaN
/// where a reading has none.
void take_repeats(Spectrum& spectrum, const RawSpectrum& raw) {
    const double one = spectrum.unit_rule.starts_with("percent") ? 100 : 1;
    for (const std::vector<double>& repeat : raw.repeats) {
        std::vector<double>& readings = spectrum.repeats.emplace_back();
        for (const std::size_t i : raw.grid.order) {
            if (!std::isnan(raw.value[i])) readings.push_back(repeat[i] / one);
        }
    }
}

/// `percent_in` is another spectrum of the list that is in percent; empty where none is.
Spectrum spectrum_of(RawSpectrum raw, const ReadOptions& options, const std::string& percent_in) {
    Spectrum spectrum = std::move(raw.spectrum);
    take_readings(spectrum, raw.grid, {.value = raw.value, .sigma = raw.sigma},
                  {.option = options.unit,
                   .comment = raw.unit,
                   .named = raw.named,
                   .percent_in = percent_in,
                   .window = options.window});
    take_repeats(spectrum, raw);
    spectrum.missing_nm.resize(spectrum.missing_nm.size() + raw.missing, std::numeric_limits<double>::quiet_NaN());
    std::ranges::copy(raw.missing_nm, std::back_inserter(spectrum.missing_nm));
    return spectrum;
}

/// The first spectrum of a list that is in percent, as it states or as its values in the window show; empty where none
/// is.
std::string spectrum_in_percent(std::span<const RawSpectrum> all, const WavelengthWindow& window) {
    const auto in_percent = [&window](const RawSpectrum& raw) {
        const std::optional<Unit> stated = raw.unit ? raw.unit : raw.named;
        if (stated || !raw.spectrum.unusable.empty()) return stated == Unit::percent;
        return shows_percent(used_values(window, raw.grid, raw.value));
    };
    const auto found = std::ranges::find_if(all, in_percent);
    return found == all.end() ? std::string{} : found->spectrum.name;
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
    static const Json nothing = Json::object();
    const Json& beside = ours ? file : nothing;
    const bool is_list = all.is_array();
    std::vector<RawSpectrum> raw;
    const auto add = [&](const Json& json, const std::string& where, const std::string& name) {
        const Json whole = completed(json, beside);
        raw.push_back(raw_spectrum({.json = whole, .where = where}, source, name));
    };
    if (!is_list) add(all, source, std::filesystem::path(source).stem().string());
    for (std::size_t i = 0; is_list && i < all.size(); ++i) {
        const std::string name = fmt::format("spectrum {}", i + 1);
        add(all[i], fmt::format("{}: {}", source, name), name);
    }
    const std::string percent_in = is_list ? spectrum_in_percent(raw, options.window) : std::string{};
    std::vector<Spectrum> spectra;
    for (RawSpectrum& each : raw) spectra.push_back(spectrum_of(std::move(each), options, percent_in));
    if (is_list) std::erase_if(spectra, [](const Spectrum& spectrum) { return spectrum.value.empty(); });
    return spectra;
}

}  // namespace skinfit
