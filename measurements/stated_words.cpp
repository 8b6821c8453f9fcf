#include "measurements/stated_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

bool contains_one_of(std::string_view text, std::initializer_list<std::string_view> phrases) {
    return std::ranges::any_of(phrases, [text](std::string_view phrase) { return contains(text, phrase); });
}

/// The words of the text with one blank before and behind each.
std::string spaced_words(std::string_view text) {
    std::string words = " ";
    for (const std::string& word : tokens_of(plain_text(text))) words += word + " ";
    return words;
}

}  // namespace

std::optional<std::string> unusable_in_prose(std::string_view prose) {
    static constexpr std::array<std::string_view, 11> certain = {
        "absorbance", "log(1/r",    "log10(1/r", "log 1/r", "irradiance",     "radiance",
        "digital n",  "raw counts", "kubelka",   "k/s",     "optical density"};
    static constexpr std::array<std::string_view, 3> whole = {" dn ", " dns ", " uncalibrated "};
    const std::string plain = plain_text(prose);
    if (contains_one_of(plain, {"reflect", "reflex", "remission", "remitt", "transmi"})) return std::nullopt;
    const auto* const phrase =
        std::ranges::find_if(certain, [&](std::string_view each) { return contains(plain, each); });
    if (phrase != certain.end()) {
        if (phrase->starts_with("log")) return "log(1/R)";
        return *phrase == "digital n" ? "digital number" : std::string(*phrase);
    }
    const std::string words = spaced_words(prose);
    const auto* const word = std::ranges::find_if(whole, [&](std::string_view each) { return contains(words, each); });
    if (word == whole.end()) return std::nullopt;
    return std::string(word->substr(1, word->size() - 2));
}

std::string remedy_for(std::string_view quantity) {
    const std::string plain = plain_text(quantity);
    if (contains_one_of(plain, {"k/s", "kubelka", "k-m", "f(r)"})) {
        return "export reflectance instead of the Kubelka-Munk function";
    }
    if (contains_one_of(plain, {"absorb", "absorp", "log", "ln", "density", "extin"}) ||
        contains_one_of(spaced_words(quantity), {" abs ", " od ", " a ", " au ", " a u "})) {
        return "export reflectance or transmittance; an absorbance A is a share of light 10^-A";
    }
    return "export reflectance: the reading of the sample over that of a white standard, both less the dark reading";
}

StatedGeometry geometry_stated(std::string_view key, std::string_view value) {
    std::string words = spaced_words(fmt::format("{} {}", key, value));
    for (std::size_t at = words.find("\xC2\xB0"); at != std::string::npos; at = words.find("\xC2\xB0", at)) {
        words.replace(at, 2, " ");
    }
    for (const std::string_view filler : {" deg ", " degree ", " degrees ", "  "}) {
        for (std::size_t at = words.find(filler); at != std::string::npos; at = words.find(filler)) {
            words.replace(at, filler.size(), " ");
        }
    }
    const auto says = [&words](std::initializer_list<std::string_view> phrases) {
        return contains_one_of(words, phrases);
    };
    StatedGeometry stated{.incidence_deg = std::nullopt, .specular = specular_stated(key, value)};
    if (says({" 45 0 ", " 45a 0 ", " 45c 0 ", " 45x 0 ", " 45 n "})) {
        stated = {.incidence_deg = 45, .specular = Specular::excluded};
    } else if (says({" 0 45 ", " 0 45a ", " 0 45c ", " 0 45x "})) {
        stated = {.incidence_deg = 0, .specular = Specular::excluded};
    } else if (says({" d 8 ", " di 8 ", " de 8 ", " 8 d ", " 8 di ", " 8 de ", " d8 ", " 8 h "})) {
        stated.incidence_deg = 8;
    } else if (says({" d 0 ", " 0 d "})) {
        stated.incidence_deg = 0;
    }
    if (!stated.specular && says({" di 8 ", " 8 di "})) stated.specular = Specular::included;
    if (!stated.specular && says({" de 8 ", " 8 de "})) stated.specular = Specular::excluded;
    return stated;
}

std::optional<Abscissa> abscissa_in_unit(std::string_view unit) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 5> written_out = {
        {{"terahertz", "THz"}, {"gigahertz", "GHz"}, {"megahertz", "MHz"}, {"electronvolt", "eV"}, {"millimet", "mm"}}};
    const std::string plain = plain_text(unit);
    for (const auto& [word, sign] : written_out) {
        if (contains(plain, word)) return abscissa_stated(sign);
    }
    if (contains(plain, "centimet")) return Abscissa{.name = "cm", .nm_per_unit = 1e7, .named_by_unit = true};
    // `m` or `A` alone are units beside the word wavelength only.
    const std::optional<Abscissa> stated = abscissa_stated(fmt::format("wavelength ({})", unit));
    if (!stated || !stated->named_by_unit || !stated->unusable.empty()) return std::nullopt;
    return stated;
}

double width_nm(const Abscissa& abscissa, double number, double width) {
    if (abscissa.nm_per_unit > 0) return abscissa.nm_per_unit * width;
    return std::abs(abscissa.nm_times_unit / (number - width / 2) - abscissa.nm_times_unit / (number + width / 2));
}

}  // namespace skinfit
