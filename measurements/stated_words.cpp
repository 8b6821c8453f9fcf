#include "measurements/stated_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The text in small letters, each run of other characters than letters and digits as one blank, blanks at both ends.
/// The sign for micro and the degree are letters too: `u` and a blank.
std::string plain(std::string_view text) {
    std::string words = " ";
    const std::string lower = lower_case(text);
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const std::string_view rest = std::string_view(lower).substr(i);
        const bool micro = rest.starts_with("\u00b5") || rest.starts_with("\u03bc");
        if (micro) ++i;
        if (micro || rest.starts_with("\xB5")) {
            words += 'u';
        } else if ((lower[i] >= 'a' && lower[i] <= 'z') || (lower[i] >= '0' && lower[i] <= '9')) {
            words += lower[i];
        } else if (words.back() != ' ') {
            words += ' ';
        }
    }
    if (words.back() != ' ') words += ' ';
    return words;
}

/// Phrases as `plain` gives them: a blank at an end says that a word begins or ends there.
std::optional<std::string_view> first_of(std::string_view words, std::span<const std::string_view> phrases) {
    const auto found = std::ranges::find_if(
        phrases, [words](std::string_view phrase) { return words.find(phrase) != std::string_view::npos; });
    return found == phrases.end() ? std::nullopt : std::optional(*found);
}

constexpr std::array<std::string_view, 5> reflecting = {" reflect", " reflex", " refl ", " remission", " remitt"};
constexpr std::array<std::string_view, 2> transmitting = {" transmi", " trans "};

/// Logarithms and ratios of reflectance or transmittance, whatever else is named beside them.
constexpr std::array<std::string_view, 12> derived = {
    " absorb",          " log ", " log10 ",         " ln ",         " kubelka",      " k s ",
    " optical density", " od ",  " optical depth ", " extinction ", " attenuation ", " derivative "};

/// What detectors and light sources have; beside the word reflectance they say where it comes from.
constexpr std::array<std::string_view, 24> detected = {
    " radian",    " irradian", " emissi",        " fluoresc", " luminesc",     " luminance", " count",     " intensit",
    " arbitrary", " arb ",     " digital num",   " dn ",      " dns ",         " adu ",      " raw data ", " raman",
    " voltage",   " volt",     " photoacoustic", " flux ",    " single beam ", " abs ",      " a u ",      " au "};

/// Of those above, what says so in prose too.
constexpr std::array<std::string_view, 10> certain = {" absorbance",     " log 1 r ",     " radiance", " irradiance",
                                                      " digital number", " dn ",          " dns ",     " raw counts ",
                                                      " kubelka",        " uncalibrated "};

std::string as_named(std::string_view title, std::string_view phrase) {
    // The word as a reader of the message finds it: stems are completed from the title.
    const std::string words = plain(title);
    const std::size_t begin = words.find(phrase) + 1;
    const std::size_t end = words.find(' ', begin + phrase.size() - (phrase.ends_with(' ') ? 2 : 1));
    return words.substr(begin, end - begin);
}

}  // namespace

std::optional<Quantity> quantity_in_title(std::string_view title) {
    std::string words = plain(title);
    const bool reflectance = first_of(words, reflecting).has_value();
    const bool transmittance = first_of(words, transmitting).has_value();
    if (reflectance != transmittance) return reflectance ? Quantity::reflectance : Quantity::transmittance;
    if (reflectance) return std::nullopt;
    if (words.starts_with(" percent ")) words.erase(0, std::string_view(" percent").size());
    if (words == " r ") return Quantity::reflectance;
    if (words == " t ") return Quantity::transmittance;
    return std::nullopt;
}

std::optional<std::string> unusable_quantity(std::string_view title) {
    const std::string words = plain(title);
    if (const auto phrase = first_of(words, derived)) return as_named(title, *phrase);
    if (first_of(words, reflecting) || first_of(words, transmitting)) return std::nullopt;
    if (const auto phrase = first_of(words, detected)) return as_named(title, *phrase);
    return std::nullopt;
}

std::optional<std::string> unusable_quantity_in_prose(std::string_view prose) {
    const std::string words = plain(prose);
    if (first_of(words, reflecting) || first_of(words, transmitting)) return std::nullopt;
    if (const auto phrase = first_of(words, certain)) return as_named(prose, *phrase);
    return std::nullopt;
}

std::string remedy_for(std::string_view quantity) {
    if (quantity.starts_with("absorb") || quantity.starts_with("log") || quantity.starts_with("ln") ||
        quantity.starts_with("optical") || quantity.starts_with("od") || quantity.starts_with("abs")) {
        return "export reflectance or transmittance; an absorbance A is a share of light 10^-A";
    }
    if (quantity.starts_with("k")) return "export reflectance instead of the Kubelka-Munk function";
    return "export reflectance: the reading of the sample over that of a white standard, both less the dark reading";
}

bool says_percent(std::string_view title) {
    const std::string words = plain(title);
    return title.find('%') != std::string_view::npos || words.find(" percent") != std::string::npos ||
           words.find(" pct ") != std::string::npos;
}

std::optional<Specular> specular_in_title(std::string_view title) {
    static constexpr std::array<std::string_view, 6> inside = {
        " sci ", " spin ", " rspin ", " specular included ", " specular component included ", " di 8 "};
    static constexpr std::array<std::string_view, 6> outside = {
        " sce ", " spex ", " rspex ", " specular excluded ", " specular component excluded ", " de 8 "};
    const std::string words = plain(title);
    const bool included = first_of(words, inside).has_value();
    const bool excluded = first_of(words, outside).has_value();
    if (included == excluded) return std::nullopt;
    return included ? Specular::included : Specular::excluded;
}

StatedGeometry geometry_in_title(std::string_view title) {
    std::string words = plain(title);
    for (const std::string_view filler : {" deg ", " degree ", " degrees "}) {
        for (std::size_t at = words.find(filler); at != std::string::npos; at = words.find(filler)) {
            words.replace(at, filler.size(), " ");
        }
    }
    const auto says = [&words](std::initializer_list<std::string_view> phrases) {
        return first_of(words, std::span(phrases.begin(), phrases.size())).has_value();
    };
    StatedGeometry stated{.incidence_deg = std::nullopt, .specular = specular_in_title(title)};
    if (says({" 45 0 ", " 45a 0 ", " 45c 0 ", " 45x 0 ", " 45 n "})) {
        stated = {.incidence_deg = 45, .specular = Specular::excluded};
    } else if (says({" 0 45 ", " 0 45a ", " 0 45c ", " 0 45x "})) {
        stated = {.incidence_deg = 0, .specular = Specular::excluded};
    } else if (says({" d 8 ", " di 8 ", " de 8 ", " 8 d ", " 8 di ", " 8 de ", " d8 ", " 8 h "})) {
        stated.incidence_deg = 8;
    } else if (says({" d 0 ", " 0 d "})) {
        stated.incidence_deg = 0;
    }
    return stated;
}

double AbscissaUnit::width_nm(double number, double width) const {
    if (!reciprocal) return factor * width;
    return std::abs(factor / (number - width / 2) - factor / (number + width / 2));
}

std::optional<AbscissaUnit> abscissa_unit(std::string_view title) {
    constexpr double light_nm_thz = 299792.458;      // c, SI 2019: exact
    constexpr double energy_nm_ev = 1239.841984332;  // h c / e, SI 2019: exact to the digits
    struct Named {
        AbscissaUnit unit;
        std::array<std::string_view, 8> phrases;  // unused ones are empty
    };
    static constexpr std::array<Named, 11> units{{
        {{.factor = 1e7, .reciprocal = true, .name = "wavenumbers in 1/cm"},
         {" wavenumber", " cm 1 ", " 1 cm ", " cm1 ", " kayser", " reciprocal c", " inverse c", " rcm "}},
        {{.factor = 1, .reciprocal = false, .name = "nanometres"}, {" nm ", " nanomet", " millimicron"}},
        {{.factor = 1e3, .reciprocal = false, .name = "micrometres"}, {" um ", " micromet", " micron", " mum "}},
        {{.factor = 0.1, .reciprocal = false, .name = "angstroms"}, {" angstr"}},
        {{.factor = 1e6, .reciprocal = false, .name = "millimetres"}, {" mm ", " millimet"}},
        {{.factor = 1e7, .reciprocal = false, .name = "centimetres"}, {" cm ", " centimet"}},
        {{.factor = 1e9, .reciprocal = false, .name = "metres"}, {" m ", " meter", " metre"}},
        {{.factor = light_nm_thz, .reciprocal = true, .name = "frequencies in THz"}, {" thz ", " terahertz "}},
        {{.factor = light_nm_thz * 1e3, .reciprocal = true, .name = "frequencies in GHz"}, {" ghz ", " gigahertz "}},
        {{.factor = light_nm_thz * 1e6, .reciprocal = true, .name = "frequencies in MHz"}, {" mhz ", " megahertz "}},
        {{.factor = energy_nm_ev, .reciprocal = true, .name = "energies in eV"}, {" ev ", " electronvolt"}},
    }};
    const std::string words = plain(title);
    std::optional<AbscissaUnit> found;
    for (const Named& named : units) {
        const bool stated = std::ranges::any_of(named.phrases, [&words](std::string_view phrase) {
            return !phrase.empty() && words.find(phrase) != std::string::npos;
        });
        if (!stated || (found && found->reciprocal && named.unit.name == "centimetres")) continue;  // cm of 1/cm
        if (found) return std::nullopt;
        found = named.unit;
    }
    return found;
}

}  // namespace skinfit
