#include "measurements/statement_keys.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "measurements/declared.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

using KeyWords = std::span<const std::string_view>;

bool is_known(std::string_view word, KeyWords words) {
    return std::ranges::find(words, word) != words.end();
}

bool any_known(const std::vector<std::string>& tokens, KeyWords words) {
    return std::ranges::any_of(tokens, [&](const std::string& token) { return is_known(token, words); });
}

/// The parts of a line between commas, semicolons and tabs.
std::vector<std::string_view> clauses_of(std::string_view line) {
    std::vector<std::string_view> clauses;
    while (!line.empty()) {
        const std::size_t end = std::min(line.find_first_of(",;\t"), line.size());
        if (const std::string_view clause = trimmed(line.substr(0, end)); !clause.empty()) clauses.push_back(clause);
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return clauses;
}

struct Parts {
    std::string_view before;
    std::string_view behind;
};

/// A clause cut at each of some words, which stand between blanks.
std::vector<Parts> cut_at_words(std::string_view clause, KeyWords words) {
    std::vector<Parts> parts;
    const std::string lower = lower_case(clause);
    for (const std::string_view word : words) {
        const std::string spaced = " " + std::string(word) + " ";
        for (std::size_t at = lower.find(spaced); at != std::string::npos; at = lower.find(spaced, at + 1)) {
            parts.push_back({.before = clause.substr(0, at), .behind = trimmed(clause.substr(at + spaced.size()))});
        }
    }
    return parts;
}

constexpr std::array<std::string_view, 4> connectives = {"is", "are", "as", "in"};

/// Wholly, but for a raw signal's words that name its reference.
ValueStatement quantity_wholly(std::string_view text) {
    static constexpr std::array<std::string_view, 3> others = {"reference", "ref", "background"};
    return any_known(tokens_of(plain_text(text)), others) ? ValueStatement{} : values_stated_wholly(text);
}

/// Words for what a file holds.
constexpr std::array<std::string_view, 19> subjects = {"spectrum", "spectra", "file",     "data",        "values",
                                                       "value",    "reading", "readings", "measurement", "measurements",
                                                       "columns",  "y",       "ordinate", "signal",      "result",
                                                       "results",  "unit",    "units",    "quantity"};

ValueStatement values_in_clause(std::string_view clause) {
    if (const ValueStatement all = quantity_wholly(clause); !all.is_empty()) return all;
    for (const Parts& parts : cut_at_words(clause, connectives)) {
        if (!any_known(tokens_of(plain_text(parts.before)), subjects)) continue;
        if (const ValueStatement said = quantity_wholly(parts.behind); !said.is_empty()) return said;
    }
    static constexpr std::array<std::string_view, 3> of = {"of", "from", "for"};
    static constexpr std::array<std::string_view, 6> phenomena = {"absorption",   "extinction", "attenuation",
                                                                  "fluorescence", "emission",   "luminescence"};
    constexpr std::size_t most_words = 3;  // of what the values are of; more is a tale
    for (const Parts& parts : cut_at_words(clause, of)) {
        const ValueStatement said = quantity_wholly(parts.before);
        const bool is_phenomenon = !any_known(tokens_of(plain_text(parts.before)), subjects) &&
                                   any_known(tokens_of(plain_text(parts.before)), phenomena);
        const bool names_quantity = said.quantity || (!said.unusable.empty() && !said.is_signal && !is_phenomenon);
        if (names_quantity && tokens_of(parts.behind).size() <= most_words) return said;
    }
    return {};
}

/// Forms that may be initials, a kind of file or an eye: `OD`.
bool is_short_form(std::string_view value) {
    static constexpr std::array<std::string_view, 10> forms = {"abs",   "od", "dn", "dns", "log",
                                                               "count", "km", "ks", "ln",  "cps"};
    const std::vector<std::string> tokens = tokens_of(plain_text(value));
    return std::ranges::all_of(tokens, [](const std::string& token) { return is_known(token, forms); });
}

/// Units of light, rather than of lengths and frequencies of anything.
bool is_of_light(const Abscissa& abscissa) {
    static constexpr std::array<std::string_view, 9> units = {"nm",   "um",  "angstrom", "1/cm", "1000/cm",
                                                              "1/um", "PHz", "THz",      "eV"};
    return abscissa.named_by_unit && is_known(abscissa.name, units);
}

/// A unit of light, or a Raman shift, in words that say nothing else.
std::optional<Abscissa> abscissa_wholly(std::string_view text) {
    static constexpr std::array<std::string_view, 29> fillers = {
        "given",     "x",           "axis",   "abscissa", "unit",     "units",      "in",          "is",
        "are",       "as",          "the",    "of",       "light",    "wavenumber", "wavenumbers", "wave",
        "number",    "numbers",     "photon", "energy",   "energies", "shift",      "shifts",      "spectral",
        "frequency", "frequencies", "raman",  "vacuum",   "values"};
    const std::optional<Abscissa> stated = abscissa_stated(text);
    if (!stated) return std::nullopt;
    const std::vector<std::string> tokens = tokens_of(plain_text(text));
    const bool reciprocal = stated->name.starts_with("1");
    const bool wholly = std::ranges::all_of(tokens, [&](const std::string& token) {
        const bool of_unit = reciprocal && (token == "1" || token == "cm" || token == "3" || token == "10");
        return of_unit || is_known(token, fillers) || is_abscissa_name(token);
    });
    static constexpr std::array<std::string_view, 2> shifts = {"shift", "shifts"};
    const bool is_shift = !stated->unusable.empty() && contains(plain_text(text), "raman") && any_known(tokens, shifts);
    return wholly && (is_of_light(*stated) || is_shift) ? stated : std::nullopt;
}

}  // namespace

bool is_ordinate_key(std::string_view key) {
    static constexpr std::array<std::string_view, 40> keys = {"technique",
                                                              "modeunit",
                                                              "viewmode",
                                                              "displaymode",
                                                              "yunits",
                                                              "yunit",
                                                              "ylabel",
                                                              "yaxis",
                                                              "yaxisunit",
                                                              "yaxisunits",
                                                              "yaxistitle",
                                                              "ytitle",
                                                              "ymode",
                                                              "ordinate",
                                                              "ordinatemode",
                                                              "ordinateunit",
                                                              "ordinateunits",
                                                              "datatype",
                                                              "datamode",
                                                              "dataunits",
                                                              "measurementmode",
                                                              "measurementtype",
                                                              "measurement",
                                                              "mode",
                                                              "type",
                                                              "quantity",
                                                              "measurand",
                                                              "units",
                                                              "unit",
                                                              "spectrumtype",
                                                              "spectraltype",
                                                              "spectraldatatype",
                                                              "photometricmode",
                                                              "measuringmode",
                                                              "valuetype",
                                                              "scantype",
                                                              "acquisitionmode",
                                                              "signaltype",
                                                              "spectrometermode",
                                                              "measuredquantity"};
    return is_known(bare_key(key), keys);
}

bool is_abscissa_key(std::string_view key) {
    static constexpr std::array<std::string_view, 15> keys = {
        "xunits",     "xunit",          "xlabel",          "xaxis",    "xaxisunit",
        "xaxisunits", "xaxistitle",     "xaxismode",       "abscissa", "abscissaunit",
        "xmode",      "wavelengthunit", "wavelengthunits", "xtitle",   "horizontalaxis"};
    return is_known(bare_key(key), keys);
}

ValueStatement values_stated_under(std::string_view key, std::string_view value, Clauses clauses) {
    static constexpr std::array<std::string_view, 4> of_letters = {"y", "parameter", "display", "photometricvalue"};
    static constexpr std::array<std::string_view, 18> parts = {
        "baseline",     "zero",       "lamp",     "light",      "source",   "illuminant",
        "illumination", "reference",  "dark",     "background", "bulb",     "excitation",
        "calibration",  "correction", "standard", "filter",     "detector", "white"};
    static constexpr std::array<std::string_view, 13> of_values = {
        "mode",     "value", "values",   "unit",     "units",       "data",       "signal",
        "spectrum", "y",     "ordinate", "quantity", "photometric", "measurement"};
    if (is_ordinate_key(key)) return values_stated_by_letter(value);
    if (is_known(bare_key(key), of_letters) && is_quantity_letter(value)) return values_stated_by_letter(value);
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (std::ranges::none_of(value, is_letter)) return {};  // numbers and dates, of rows by the thousand
    if (any_known(tokens_of(plain_text(key)), parts)) return {};
    const ValueStatement said = values_stated_in_prose(value, clauses);
    const bool is_amount =
        said.unusable.empty() && starts_like_a_number(value);  // as of a standard: `100 % reflectance`
    const bool is_name = is_short_form(value) && !any_known(tokens_of(plain_text(key)), of_values);
    const bool is_sure = !said.is_signal && (said.quantity || !said.unusable.empty()) && !is_amount && !is_name;
    return is_sure ? said : ValueStatement{};
}

std::optional<Abscissa> abscissa_stated_under(std::string_view key, std::string_view value) {
    static constexpr std::array<std::string_view, 28> of_axis = {
        "column",     "columns", "data",     "format",     "x",           "xaxis",       "axis",
        "unit",       "units",   "mode",     "label",      "title",       "type",        "abscissa",
        "energy",     "scale",   "spectral", "domain",     "start",       "end",         "wavelength",
        "wavenumber", "first",   "last",     "horizontal", "wavelengths", "wavenumbers", "frequency"};
    if (is_abscissa_key(key)) return abscissa_stated(value);
    const std::vector<std::string> tokens = tokens_of(plain_text(key));
    const bool speaks_of_axis =
        std::ranges::all_of(tokens, [](const std::string& token) { return is_known(token, of_axis); });
    return speaks_of_axis ? abscissa_stated_in_prose(value) : std::nullopt;
}

ValueStatement values_stated_in_prose(std::string_view line, Clauses clauses) {
    ValueStatement found;
    bool contradicts = false;
    bool all_state = true;
    for (const std::string_view clause : clauses_of(line)) {
        const ValueStatement said = values_in_clause(clause);
        all_state = all_state && !said.is_empty();
        contradicts = contradicts || (!said.unusable.empty() && found.quantity) ||
                      (!found.unusable.empty() && said.quantity) ||
                      (said.quantity && found.quantity && said.quantity != found.quantity);
        if (said.quantity) found.quantity = said.quantity;
        if (said.unit && !found.unit) found.unit = said.unit;
        if (said.unusable.empty() || !found.unusable.empty()) continue;
        found.unusable = said.unusable;
        found.is_signal = said.is_signal;
    }
    if (contradicts && all_state && !found.unusable.empty())
        return {.unusable = std::string(line)};  // for some of them
    if (contradicts || (clauses == Clauses::cells && !all_state)) return {};
    return found;
}

std::optional<Abscissa> abscissa_stated_in_prose(std::string_view line) {
    for (const std::string_view clause : clauses_of(line)) {
        if (const auto stated = abscissa_wholly(clause)) return stated;
    }
    return std::nullopt;
}

}  // namespace skinfit
