#include "measurements/value_statement.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <vector>

#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

using Words = std::span<const std::string_view>;

bool is_one_of(std::string_view word, Words words) {
    return std::ranges::find(words, word) != words.end();
}

bool any_is_one_of(const std::vector<std::string>& tokens, Words words) {
    return std::ranges::any_of(tokens, [&](const std::string& token) { return is_one_of(token, words); });
}

bool any_starts_with(const std::vector<std::string>& tokens, Words beginnings) {
    return std::ranges::any_of(tokens, [&](const std::string& token) {
        return std::ranges::any_of(beginnings, [&](std::string_view word) { return token.starts_with(word); });
    });
}

/// `text` without blanks and underscores.
std::string compact(std::string_view text) {
    std::string kept(text);
    std::erase_if(kept, [](char c) { return c == ' ' || c == '_' || c == '\t'; });
    return kept;
}

/// Without what stands in brackets at its end, and without percent signs: `Raw [counts]` is `raw`.
std::string without_unit(std::string text) {
    while (!text.empty() && (text.back() == ')' || text.back() == ']')) {
        const std::size_t open = text.rfind(text.back() == ')' ? '(' : '[');
        if (open == std::string::npos) break;
        text.erase(open);
        text = std::string(trimmed(text));
    }
    std::erase(text, '%');
    for (const std::string_view word : {"percent", "pct", "fraction"}) {
        if (const std::size_t at = text.find(word); at != std::string::npos) text.erase(at, word.size());
    }
    std::ranges::replace(text, '_', ' ');
    return std::string(trimmed(text));
}

/// A power of a length, as in `W/m2`, and no word: `w/makeup`.
bool holds_power(const std::string& packed) {
    for (const std::string_view power : {"w/m", "w/cm", "w/mm", "w/um"}) {
        for (std::size_t at = packed.find(power); at != std::string::npos; at = packed.find(power, at + 1)) {
            const std::size_t end = at + power.size();
            if (end == packed.size() || std::isalpha(static_cast<unsigned char>(packed[end])) == 0) return true;
        }
    }
    return false;
}

/// Computed from a reflectance or measured instead of one, whatever other words stand beside.
bool is_never_usable(const std::string& text, const std::vector<std::string>& tokens) {
    static constexpr std::array<std::string_view, 22> words = {
        "abs", "od",         "dn",         "dns", "log", "log10",     "lgr", "ks",   "logr", "counts", "count",
        "cps", "extinction", "derivative", "snv", "rfu", "emittance", "adu", "brdf", "bsdf", "lnr",    "attenuation"};
    static constexpr std::array<std::string_view, 12> beginnings = {
        "absorb",   "absorp",  "radianc",    "irradian",   "fluoresc",  "luminesc",
        "phosphor", "kubelka", "emissivity", "extinktion", "derivativ", "luminance"};
    static constexpr std::array<std::string_view, 35> phrases = {
        "log(1/",      "log1/",         "log10(",         "log(r",         "-log",       "ln(1/", "ln(r",
        "lg(",         "k/s",           "f(r)",           "w/(m",          "w/sr",       "w.m-2", "umol",
        "1-refl",      "1-r/",          "1/refl",         "1/sr",          "sr-1",       "sr^-1", "o.d.",
        "opticaldens", "digitalnumber", "colourstrength", "colorstrength", "photonflux", "lg1/",  "(db)",
        "[db]",        "(mw)",          "[mw]",           "(mv)",          "[mv]",       "(v)",   "[v]"};
    static constexpr std::array<std::string_view, 7> whole = {"1-r",     "1/r",      "k-m",       "km",
                                                              "kmunits", "k-munits", "returnloss"};
    const std::string packed = compact(text);
    return any_is_one_of(tokens, words) || any_starts_with(tokens, beginnings) || holds_power(packed) ||
           std::ranges::any_of(phrases, [&](std::string_view phrase) { return contains(packed, phrase); }) ||
           is_one_of(packed, whole) || text == "ln r";
}

/// Raw signals, unless the same words call them a reflectance or transmittance; at an end of a name or as all of it, as
/// in `intensity of arm`, not in `high intensity site`.
bool is_raw_signal(const std::string& text, const std::vector<std::string>& tokens) {
    static constexpr std::array<std::string_view, 9> words = {
        "intensity", "intensities", "emission", "scope", "voltage", "photons", "raman", "flux", "scattering"};
    static constexpr std::array<std::string_view, 16> whole = {
        "raw",       "raw data", "raw signal",      "signal",         "dark signal", "dark current", "au",    "a.u.",
        "reference", "ref",      "white reference", "dark reference", "background",  "int.",         "power", "int"};
    const std::string bare = without_unit(text);
    if (is_one_of(bare, whole)) return true;
    const std::vector<std::string> bare_tokens = tokens_of(bare);
    if (bare_tokens.empty()) return any_is_one_of(tokens, words);
    return is_one_of(bare_tokens.front(), words) || is_one_of(bare_tokens.back(), words);
}

std::optional<Quantity> quantity_of(const std::string& text, const std::vector<std::string>& tokens) {
    static constexpr std::array<std::string_view, 6> reflecting = {"refle",
                                                                   "refl",
                                                                   "remission",
                                                                   "remittance",
                                                                   "riflett",
                                                                   "r\xC3\xA9"
                                                                   "flect"};
    static constexpr std::array<std::string_view, 3> transmitting = {"transmi", "transm", "trasmitt"};
    static constexpr std::array<std::string_view, 1> trans = {"trans"};
    const std::string packed = compact(text);
    const auto states = [&](std::string_view letter) {
        const std::size_t at = packed.find("%" + std::string(letter));
        const bool leads = at != std::string::npos && (at + 2 == packed.size() || tokens.size() == 1 ||
                                                       !std::isalpha(static_cast<unsigned char>(packed[at + 2])));
        return leads;
    };
    const bool reflects = any_starts_with(tokens, reflecting) || contains(text, "reflectance") || states("r");
    const bool transmits = any_starts_with(tokens, transmitting) || any_is_one_of(tokens, trans) ||
                           contains(text, "transmittance") || states("t");
    if (reflects == transmits) return std::nullopt;
    return reflects ? Quantity::reflectance : Quantity::transmittance;
}

/// A percent sign is a unit but behind an amount: `5 % melanin` is a name, `100%T` is not.
bool states_percent(const std::string& text, const std::vector<std::string>& tokens) {
    static constexpr std::array<std::string_view, 3> words = {"percent", "pct", "prozent"};
    if (any_is_one_of(tokens, words) || contains(text, "percent")) return true;
    const std::string packed = compact(text);
    for (std::size_t at = packed.find('%'); at != std::string::npos; at = packed.find('%', at + 1)) {
        const bool amount = at > 0 && is_digit(packed[at - 1]);
        const char next = at + 1 < packed.size() ? packed[at + 1] : ' ';
        if (!amount || next == 'r' || next == 't') return true;
    }
    return contains(packed, "x100)") || contains(packed, "x100]") || packed.ends_with("x100");
}

bool states_fraction(const std::string& text, const std::vector<std::string>& tokens) {
    static constexpr std::array<std::string_view, 5> words = {"fraction", "unitless", "dimensionless", "fractional",
                                                              "decimal"};
    static constexpr std::array<std::string_view, 9> phrases = {"[1.0]", "(1.0)", "[1]",    "(0-1)", "[0-1]",
                                                                "[0,1]", "[-]",   "(0..1)", "[0..1]"};
    const std::string packed = compact(text);
    return any_is_one_of(tokens, words) ||
           std::ranges::any_of(phrases, [&](std::string_view phrase) { return contains(packed, phrase); });
}

/// `x10000`, `*1e4`, `(10^-4)` or a thousandth: numbers that are neither fractions nor percent. Tenfold only beside the
/// word for a quantity, and no date: `Subject x10` and `20/10/2026` are names.
bool is_scaled(const std::string& text, bool names_quantity) {
    const std::string packed = compact(text);
    if (contains(packed, "\xE2\x80\xB0") || contains(packed, "permille") || contains(packed, "10^") ||
        contains(packed, "10**")) {
        return true;
    }
    for (std::size_t at = text.find_first_of("x*/"); at != std::string::npos; at = text.find_first_of("x*/", at + 1)) {
        const bool inside_a_word =
            text[at] == 'x' && at > 0 && std::isalpha(static_cast<unsigned char>(text[at - 1])) != 0;
        const bool inside_a_date = text[at] == '/' && at > 0 && is_digit(text[at - 1]);
        const std::string_view number = trimmed(std::string_view(text).substr(at + 1));
        const std::size_t size = std::min(number.find_first_not_of("0123456789e"), number.size());
        const bool is_power = number.starts_with("10") || number.starts_with("1e");
        if (inside_a_word || inside_a_date || !is_power || size < 2 || number.substr(0, size) == "100") continue;
        if (names_quantity || number.substr(0, size) != "10") return true;
    }
    return false;
}

/// What may stand beside the word for a quantity, between blanks: parts of units and of formulas, words for readings.
constexpr std::string_view fillers =
    " digital given transformed spectrum spectra spectral data value values reading readings unit units mode "
    "in is are as the of measured y axis scale level mean average apparent file raw signal total diffuse "
    "regular hemispherical specular directional relative absolute factor number numbers optical density munk "
    "function f r t a u au k s m 1 0 10 100 2 w uw cm m2 cm2 sr nm measurement measurements internal 1st 2nd "
    "first ";

bool is_filler(const std::string& token) {
    return fillers.find(" " + token + " ") != std::string_view::npos;
}

}  // namespace

ValueStatement values_stated(std::string_view text) {
    const std::string plain = plain_text(text);
    const std::vector<std::string> tokens = tokens_of(plain);
    ValueStatement statement{.quantity = quantity_of(plain, tokens)};
    const bool is_unit_of_signals = text == "mV" || text == "mW" || text == "dB";  // in capitals they are initials
    if (is_unit_of_signals || is_never_usable(plain, tokens) || is_scaled(plain, statement.quantity.has_value())) {
        return {.unusable = std::string(text)};
    }
    if (!statement.quantity && is_raw_signal(plain, tokens)) return {.unusable = std::string(text), .is_signal = true};
    if (states_percent(plain, tokens)) {
        statement.unit = Unit::percent;
    } else if (states_fraction(plain, tokens)) {
        statement.unit = Unit::fraction;
    }
    return statement;
}

ValueStatement values_stated_wholly(std::string_view text) {
    const ValueStatement statement = values_stated(text);
    if (statement.is_empty()) return {};
    const std::vector<std::string> tokens = tokens_of(plain_text(text));
    const bool wholly = std::ranges::all_of(
        tokens, [](const std::string& token) { return is_filler(token) || !values_stated(token).is_empty(); });
    return wholly ? statement : ValueStatement{};
}

bool is_single_letter(std::string_view name) {
    return without_unit(plain_text(name)).size() == 1;
}

bool is_quantity_letter(std::string_view name) {
    const std::string letter = without_unit(plain_text(name));
    return letter == "r" || letter == "t" || letter == "a";
}

ValueStatement values_stated_by_letter(std::string_view text) {
    ValueStatement statement = values_stated(text);
    if (!is_quantity_letter(text) || statement.quantity) return statement;
    const std::string letter = without_unit(plain_text(text));
    if (text == "a") return statement;  // a name, as b is
    if (letter == "a") return {.unusable = std::string(text)};
    statement.quantity = letter == "r" ? Quantity::reflectance : Quantity::transmittance;
    return statement;
}

}  // namespace skinfit
