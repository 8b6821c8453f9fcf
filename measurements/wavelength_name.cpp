#include "measurements/wavelength_name.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/text.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::string_view without_marks(std::string_view text) {
    const auto is_mark = [](char c) { return contains(" _-.()[]:=@", {&c, 1}); };
    const auto closes = [&] { return text.back() == ')' && contains(text.substr(1), "("); };  // as in log(1/R)
    while (!text.empty() && is_mark(text.back()) && !closes()) text.remove_suffix(1);
    while (!text.empty() && is_mark(text.front())) text.remove_prefix(1);
    return text;
}

/// What a name says about wavelengths and values in general.
bool says_nothing(std::string_view words) {
    static constexpr std::array<std::string_view, 24> known = {
        "",     "spec", "spectral",  "spectral_nm", "spectrum", "nm",      "wl",  "wv",
        "wvl",  "w",    "wave",      "wavelength",  "lambda",   "l",       "x",   "wavelength_nm",
        "band", "ref",  "lambda_nm", "mean",        "avg",      "average", "rfl", "rho"};
    return std::ranges::find(known, words) != known.end();
}

/// Words that say what the values are: quantity, unit, specular state, uncertainty.
bool says_of_values(std::string_view words) {
    static constexpr std::array<std::string_view, 3> known = {"refl", "trans", "abs"};
    const ValueStatement stated = values_stated_by_letter(words);
    return std::ranges::find(known, lower_case(words)) != known.end() || stated.quantity || stated.unit ||
           !stated.unusable.empty() || specular_stated(words) || uncertainty_named(words);
}

struct Digits {
    std::size_t begin = 0;
    std::size_t size = 0;
};

/// The longest run of digits and points.
Digits longest_digits(std::string_view text) {
    constexpr std::string_view digits = "0123456789";
    Digits best;
    for (std::size_t begin = text.find_first_of(digits); begin != std::string_view::npos;) {
        std::size_t end = std::min(text.find_first_not_of("0123456789.", begin), text.size());
        const std::size_t next = end;
        while (text[end - 1] == '.') --end;
        if (end - begin > best.size) best = {.begin = begin, .size = end - begin};
        begin = text.find_first_of(digits, next);
    }
    return best;
}

}  // namespace

std::optional<WavelengthName> wavelength_named(std::string_view name, bool decimal_comma) {
    static constexpr std::array<std::string_view, 7> units = {"nm", "um", "cm-1", "1/cm", "thz", "ev", "angstrom"};
    std::string text(name);
    const std::size_t comma = text.find(',');
    if (decimal_comma && comma != std::string::npos) text[comma] = '.';
    std::string plain = plain_text(text);
    if (plain.size() != text.size()) text = plain;
    const Digits digits = longest_digits(plain);
    if (digits.size == 0) return std::nullopt;
    const std::optional<double> number = parse_number(std::string_view(plain).substr(digits.begin, digits.size));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    const std::string_view shown = text;
    const std::string_view prefix = without_marks(shown.substr(0, digits.begin));
    std::string_view suffix = without_marks(shown.substr(digits.begin + digits.size));
    WavelengthName found{.number = *number, .unit = {}, .about = {}};
    for (const std::string_view unit : units) {
        const std::string after = lower_case(suffix).substr(0, unit.size() + 1);
        const bool ends = after.size() <= unit.size() || std::isalnum(static_cast<unsigned char>(after.back())) == 0;
        if (!after.starts_with(unit) || !ends || !found.unit.empty()) continue;
        found.unit = unit;
        suffix = without_marks(suffix.substr(unit.size()));
    }
    constexpr double beyond_nm = 2500;  // chosen: of spectrometers; what goes further in A is in angstrom
    if (suffix == "A" && *number > beyond_nm) {
        found.unit = "angstrom";
        suffix = {};
    }
    for (const std::string_view part : {prefix, suffix}) {
        if (says_nothing(lower_case(part))) continue;
        if (!says_of_values(part)) return std::nullopt;
        found.about += (found.about.empty() ? "" : " ") + std::string(part);
    }
    return found;
}

}  // namespace skinfit
