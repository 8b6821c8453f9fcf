#include "measurements/json_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/value_statement.hpp"

namespace skinfit {
namespace {

/// Names of `json_names` that describe a measurement, wherever they stand.
constexpr std::array<std::string_view, 10> describing = {
    "unit",       "quantity", "incidence_deg", "specular",       "viewing_cone_deg",
    "instrument", "site",     "aperture_mm",   "bandpass_shape", "bandpass_width_nm"};

bool is_in(std::string_view name, std::span<const std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
}

std::string word_of(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Takes what objects inside `whole` say under the names that describe a measurement. The unit of an abscissa or an
/// aperture is not that of the values.
void take_from_inside(Json& whole) {
    Json inside = Json::object();
    for (const auto& [name, value] : whole.items()) {
        if (!value.is_object()) continue;
        for (const auto& [key, each] : value.items()) {
            const bool other_unit = key == "unit" && each.is_string() && abscissa_stated(each.get<std::string>());
            if (is_in(key, describing) && !other_unit && !whole.contains(key)) inside[key] = each;
        }
    }
    whole.update(inside);
}

/// The names of the object without a meaning of their own, with scalars as their values, also those inside objects.
struct NamedWord {
    std::string name;
    std::string word;
};

void add_words(const Json& object, const std::string& parent, std::vector<NamedWord>& words) {
    for (const auto& [name, value] : object.items()) {
        if (value.is_object()) add_words(value, name, words);
        if (!value.is_string() && !value.is_number()) continue;
        const bool is_unit_of_parent = !parent.empty() && (name == "unit" || name == "units");
        if (is_unit_of_parent) words.push_back({.name = parent + " " + name, .word = word_of(value)});
        if (!is_in(name, json_names)) words.push_back({.name = name, .word = word_of(value)});
    }
}

std::vector<NamedWord> words_in(const JsonObject& object) {
    std::vector<NamedWord> words;
    add_words(object.json, {}, words);
    return words;
}

/// True for names of the unit of an abscissa, as `start_unit`, `frequency` or `unit_x`.
bool is_of_abscissa(std::string_view name) {
    const std::string key = bare_key(name);
    const bool of_x =
        key == "x" || key == "unitx" || key == "unitsx" || (key.starts_with("x") && contains(key, "unit"));
    return of_x || std::ranges::any_of(std::array{"start", "step", "abscissa", "spectral", "frequency", "wavelength",
                                                  "wavenumber", "energy"},
                                       [&key](std::string_view word) { return contains(key, word); });
}

std::optional<Abscissa> abscissa_in(const NamedWord& named) {
    if (!is_of_abscissa(named.name) || !is_abscissa_name(named.word)) return std::nullopt;
    const std::optional<Abscissa> stated = abscissa_stated(named.word);
    return stated && stated->named_by_unit ? stated : std::nullopt;
}

/// Pairs of `notes` that say what the values are.
void take_notes(FileStatements& statements, const JsonObject& object) {
    const Json* const notes = object.find("notes");
    if (notes == nullptr || !notes->is_array()) return;
    for (const Json& note : *notes) {
        if (!note.is_array() || note.size() != 2 || !note[0].is_string() || !note[1].is_string()) continue;
        const std::string key = note[0].get<std::string>();
        const std::string value = note[1].get<std::string>();
        const ValueStatement stated = is_ordinate_key(key) ? values_stated_by_letter(value) : ValueStatement{};
        if (!statements.values.quantity) statements.values.quantity = stated.quantity;
        if (statements.values.unusable.empty()) statements.values.unusable = stated.unusable;
        if (!statements.specular) statements.specular = specular_stated(key, value);
    }
}

bool is_of_missing_values(std::string_view name) {
    static constexpr std::array<std::string_view, 14> names = {
        "fillvalue",  "fill",          "nodata",           "nodatavalue",      "missingvalue",
        "nullvalue",  "ignorevalue",   "dataignorevalue",  "missingvaluecode", "missingcode",
        "fillnumber", "missingnumber", "missingindicator", "navalue"};
    return is_in(bare_key(name), names);
}

/// The meaning of a name that says how far the spectrum goes; empty for others.
std::string_view extent_of(std::string_view name) {
    static constexpr std::array<std::string_view, 6> last = {"end", "stop", "last", "endnm", "stopnm", "lastnm"};
    if (const auto declared = declared_by(0, name, "1")) {
        return declared->meaning == "count"     ? "count"
               : declared->meaning == "first x" ? "first"
               : declared->meaning == "last x"  ? "last"
                                                : "";
    }
    if (is_in(bare_key(name), last)) return "last";
    return name == "count" ? "count" : "";
}

}  // namespace

Json completed(const Json& spectrum, const Json& file) {
    if (!spectrum.is_object()) return spectrum;
    Json whole = spectrum;
    take_from_inside(whole);
    const bool in_steps = whole.contains("start") || whole.contains("step");
    for (const auto& [name, value] : file.items()) {
        const bool of_other_axis = (whole.contains("wavelength_nm") && (name == "start" || name == "step")) ||
                                   (in_steps && name == "wavelength_nm");
        if (name == "spectra" || name == "name" || of_other_axis) continue;
        if (!whole.contains(name)) {
            whole[name] = value;
        } else if (name == "notes" && value.is_array() && whole[name].is_array()) {
            for (const Json& note : value) whole[name].push_back(note);
        }
    }
    take_from_inside(whole);
    return whole;
}

FileStatements statements_in(const JsonObject& object) {
    const std::vector<NamedWord> words = words_in(object);
    std::vector<std::string> texts;
    for (const NamedWord& each : words) texts.push_back(fmt::format("{}: {}", each.name, each.word));
    std::vector<Comment> comments;
    for (const std::string& each : texts) comments.push_back({.line = 0, .text = each});
    FileStatements statements = statements_in(object.where, comments, {});
    for (const NamedWord& each : words) {
        if (!statements.abscissa) statements.abscissa = abscissa_in(each);
    }
    take_notes(statements, object);
    return statements;
}

std::vector<double> missing_values(const JsonObject& object) {
    std::vector<double> numbers;
    for (const NamedWord& each : words_in(object)) {
        if (!is_of_missing_values(each.name)) continue;
        if (const std::optional<double> number = parse_number(each.word)) numbers.push_back(*number);
    }
    return numbers;
}

std::vector<FileDoubt> contradictions(const JsonObject& object, std::span<const double> x) {
    std::vector<FileDoubt> doubts;
    for (const NamedWord& each : words_in(object)) {
        const std::string_view extent = extent_of(each.name);
        const std::optional<double> stated = parse_number(each.word);
        if (extent.empty() || !stated || x.empty()) continue;
        const double step = x.size() > 1 ? x.back() - x[x.size() - 2] : 0;
        double found = extent == "first" ? x.front() : x.back();
        if (extent == "count") found = static_cast<double>(x.size());
        const double allowed = extent == "count" ? 0 : 1e-4 * std::abs(found);
        const bool is_end =
            extent == "last" && std::abs(found + step - *stated) <= allowed;  // as ranges of numpy have it
        if (std::abs(found - *stated) <= allowed || is_end) continue;
        doubts.push_back({.message = fmt::format("{} is {}, and the spectrum has {}", each.name, each.word, found),
                          .remedy = "check that the file is complete and unchanged"});
    }
    return doubts;
}

bool is_understood(std::string_view name, const Json& value) {
    const bool is_unit =
        value.is_string() && abscissa_in({.name = std::string(name), .word = value.get<std::string>()});
    return is_unit || is_statement_key(name) || is_of_missing_values(name) || !extent_of(name).empty();
}

}  // namespace skinfit
