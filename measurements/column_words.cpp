#include "measurements/column_words.hpp"

#include <algorithm>
#include <array>

#include "measurements/uncertainty_name.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {

namespace {

/// What stands before a unit in brackets.
std::string before_unit(std::string_view name) {
    const std::string plain = plain_text(name);
    return plain.substr(0, plain.find_first_of("(["));
}

std::string in_words(const std::vector<std::string>& tokens) {
    std::string text;
    for (const std::string& token : tokens) text += (text.empty() ? "" : " ") + token;
    return text;
}

}  // namespace

bool counts_readings(std::string_view name) {
    static constexpr std::array<std::string_view, 12> words = {"index", "pixel", "pixels", "band", "bands", "channel",
                                                               "row",   "#",     "no.",    "no",   "nr",    "line"};
    return std::ranges::find(words, plain_text(name)) != words.end();
}

bool is_label_in_front(std::string_view name) {
    static constexpr std::array<std::string_view, 14> words = {
        "id",        "sample", "n",    "i",    "number",  "rownames", "", "sample number",
        "sample no", "name",   "date", "time", "level_0", "idx"};
    const std::string plain = plain_text(name);
    return counts_readings(name) || plain.starts_with("unnamed") || plain.starts_with("sample") ||
           std::ranges::find(words, plain) != words.end();
}

bool counts_repeats(std::string_view name) {
    static constexpr std::array<std::string_view, 6> words = {"n",      "count",      "n readings",
                                                              "number", "replicates", "repeats"};
    return std::ranges::find(words, in_words(tokens_of(before_unit(name)))) != words.end();
}

bool is_condition(std::string_view name) {
    static constexpr std::array<std::string_view, 16> words = {
        "fwhm",        "bandwidth", "bandpass",         "slit",         "slit width", "spectral bandwidth",
        "temperature", "temp",      "integration time", "exposure",     "humidity",   "exposure time",
        "resolution",  "t int",     "temp c",           "temperature c"};
    return std::ranges::find(words, in_words(tokens_of(before_unit(name)))) != words.end();
}

bool is_name_of_values(std::string_view name) {
    static constexpr std::array<std::string_view, 5> words = {"mean", "average", "avg", "r", "t"};
    const ValueStatement stated = values_stated_by_letter(name);
    const std::vector<std::string> tokens = tokens_of(plain_text(name));
    return stated.quantity.has_value() || std::ranges::any_of(tokens, [](const std::string& token) {
               return std::ranges::find(words, token) != words.end();
           });
}

bool is_bound(std::string_view name) {
    static constexpr std::array<std::string_view, 11> words = {"min",   "max", "minimum", "maximum", "lower", "upper",
                                                               "range", "q25", "q75",     "q1",      "q3"};
    static constexpr std::array<std::string_view, 4> values = {"r", "t", "reflectance", "transmittance"};
    std::vector<std::string> tokens = tokens_of(plain_text(name));
    std::erase_if(tokens, [](const std::string& token) { return std::ranges::find(values, token) != values.end(); });
    return tokens.size() == 1 && std::ranges::find(words, tokens.front()) != words.end();
}

bool names_specimens(std::string_view name) {
    static constexpr std::array<std::string_view, 25> words = {
        "id",   "sample", "subject",     "participant", "patient", "volunteer", "site",     "location", "scan",
        "spot", "no",     "specimen",    "replicate",   "repeat",  "spectrum",  "position", "name",     "subj",
        "nr",   "number", "measurement", "person",      "code",    "filename",  "file"};
    const std::vector<std::string> tokens = tokens_of(plain_text(name));
    return !tokens.empty() && std::ranges::all_of(tokens, [](const std::string& token) {
        return std::ranges::find(words, token) != words.end();
    });
}

bool is_raw_beside_quantity(std::string_view name) {
    static constexpr std::array<std::string_view, 8> words = {"dark", "white", "sample", "target",
                                                              "lamp", "light", "scope",  "object"};
    return std::ranges::find(words, plain_base(name)) != words.end();
}

bool is_raw_of_jaz(const std::vector<std::string>& names, std::size_t c) {
    return c > 0 && c < 4 && names == std::vector<std::string>{"W", "D", "R", "S", "P"};
}

}  // namespace skinfit
