#include "measurements/abscissa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// Exact by the definitions of the SI (BIPM 2019, The International System of Units, 9th edition).
constexpr double speed_of_light_nm_thz = 299'792.458;
constexpr double planck_times_light_nm_ev = 6.626'070'15e-34 * 299'792'458.0 / 1.602'176'634e-19 * 1e9;

struct UnitName {
    std::string_view word;  ///< as it stands alone, or between blanks, brackets or underscores
    std::string_view name;
    double nm_per_unit;
    double nm_times_unit;
};

constexpr std::array<UnitName, 32> units = {{{"nm", "nm", 1, 0},
                                             {"nanometer", "nm", 1, 0},
                                             {"nanometers", "nm", 1, 0},
                                             {"nanometre", "nm", 1, 0},
                                             {"nanometres", "nm", 1, 0},
                                             {"nanomètres", "nm", 1, 0},
                                             {"um", "um", 1000, 0},
                                             {"mu", "um", 1000, 0},
                                             {"micron", "um", 1000, 0},
                                             {"microns", "um", 1000, 0},
                                             {"micrometer", "um", 1000, 0},
                                             {"micrometers", "um", 1000, 0},
                                             {"micrometre", "um", 1000, 0},
                                             {"micrometres", "um", 1000, 0},
                                             {"angstrom", "angstrom", 0.1, 0},
                                             {"angstroms", "angstrom", 0.1, 0},
                                             {"pm", "pm", 1e-3, 0},
                                             {"mm", "mm", 1e6, 0},
                                             {"m", "m", 1e9, 0},
                                             {"meters", "m", 1e9, 0},
                                             {"metres", "m", 1e9, 0},
                                             {"phz", "PHz", 0, speed_of_light_nm_thz * 1e-3},
                                             {"thz", "THz", 0, speed_of_light_nm_thz},
                                             {"ghz", "GHz", 0, speed_of_light_nm_thz * 1e3},
                                             {"mhz", "MHz", 0, speed_of_light_nm_thz * 1e6},
                                             {"khz", "kHz", 0, speed_of_light_nm_thz * 1e9},
                                             {"hz", "Hz", 0, speed_of_light_nm_thz * 1e12},
                                             {"ev", "eV", 0, planck_times_light_nm_ev},
                                             {"mev", "meV", 0, planck_times_light_nm_ev * 1e3},
                                             {"kev", "keV", 0, planck_times_light_nm_ev * 1e-3},
                                             {"kayser", "1/cm", 0, 1e7},
                                             {"kk", "1000/cm", 0, 1e4}}};

bool holds(const std::vector<std::string>& tokens, std::string_view word) {
    return std::ranges::find(tokens, word) != tokens.end();
}

Abscissa in_unit(const UnitName& unit) {
    return {.name = std::string(unit.name),
            .nm_per_unit = unit.nm_per_unit,
            .nm_times_unit = unit.nm_times_unit,
            .unusable = {},
            .named_by_unit = true};
}

/// `1/cm`, `cm-1`, `cm^-1` and their kin, also of metres.
std::optional<Abscissa> reciprocal_length(std::string_view packed) {
    struct Form {
        std::string_view text;
        std::string_view name;
        double nm_times_unit;
    };
    static constexpr std::array<Form, 21> forms = {
        {{"10^3cm-1", "1000/cm", 1e4}, {"10^3cm^-1", "1000/cm", 1e4}, {"1/cm", "1/cm", 1e7},   {"cm-1", "1/cm", 1e7},
         {"cm^-1", "1/cm", 1e7},       {"cm^{-1}", "1/cm", 1e7},      {"cm**-1", "1/cm", 1e7}, {"percm", "1/cm", 1e7},
         {"(/cm)", "1/cm", 1e7},       {"1/um", "1/um", 1e3},         {"um-1", "1/um", 1e3},   {"um^-1", "1/um", 1e3},
         {"1/nm", "1/nm", 1},          {"nm-1", "1/nm", 1},           {"nm^-1", "1/nm", 1},    {"1/mm", "1/mm", 1e6},
         {"mm-1", "1/mm", 1e6},        {"mm^-1", "1/mm", 1e6},        {"1/m", "1/m", 1e9},     {"m-1", "1/m", 1e9},
         {"m^-1", "1/m", 1e9}}};
    const auto form = std::ranges::find_if(forms, [&](const Form& each) { return contains(packed, each.text); });
    if (form == forms.end()) return std::nullopt;
    return Abscissa{.name = std::string(form->name),
                    .nm_per_unit = 0,
                    .nm_times_unit = form->nm_times_unit,
                    .unusable = {},
                    .named_by_unit = true};
}

std::optional<Abscissa> stated_unit(const std::string& text, const std::vector<std::string>& tokens,
                                    bool speaks_of_wavelengths) {
    std::string packed = text;
    std::erase_if(packed, [](char c) { return c == ' ' || c == '_'; });
    if (const auto reciprocal = reciprocal_length(packed)) return reciprocal;
    for (const UnitName& unit : units) {
        // `m` and `mu` alone may be anything; beside the word wavelength they are its unit.
        const bool is_short = unit.word == "m" || unit.word == "mu";
        if (holds(tokens, unit.word) && (!is_short || speaks_of_wavelengths)) return in_unit(unit);
    }
    const bool in_angstroms = contains(packed, "(a)") || contains(packed, "[a]") || packed.ends_with("/a");
    if (in_angstroms && speaks_of_wavelengths) return in_unit({"a", "angstrom", 0.1, 0});  // `lambda a` is of scan a
    return std::nullopt;
}

bool speaks_of_wavenumbers(const std::string& plain) {
    static constexpr std::array<std::string_view, 4> words = {"wavenumber", "wave number", "wellenzahl",
                                                              "nombre d'onde"};
    return std::ranges::any_of(words, [&](std::string_view word) { return contains(plain, word); });
}

bool speaks_of_wavelengths(const std::vector<std::string>& tokens) {
    static constexpr std::array<std::string_view, 4> whole = {"wl", "wvl", "wave", "waves"};
    static constexpr std::array<std::string_view, 9> beginnings = {
        "wavel", "lambda", "wellenl", "longueur", "longitud", "lunghe", "wvlgth", "wlength", "golfl"};
    constexpr std::size_t digits_of_a_model = 3;  // the spectrometer Lambda 950
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::string& token = tokens[i];
        const bool is_model = token == "lambda" && i + 1 < tokens.size() && tokens[i + 1].size() >= digits_of_a_model &&
                              std::ranges::all_of(tokens[i + 1], is_digit);
        const bool is_word =
            std::ranges::find(whole, token) != whole.end() ||
            std::ranges::any_of(beginnings, [&](std::string_view word) { return token.starts_with(word); });
        if (is_word && !is_model) return true;
    }
    return false;
}

}  // namespace

std::optional<Abscissa> abscissa_stated(std::string_view text) {
    const std::string plain = plain_text(text);
    const std::vector<std::string> tokens = tokens_of(plain);
    const bool wavenumber = speaks_of_wavenumbers(plain);
    const bool wavelength = !wavenumber && speaks_of_wavelengths(tokens);
    const Abscissa unusable{.name = {}, .nm_per_unit = 0, .nm_times_unit = 0, .unusable = std::string(text)};
    const bool shift = holds(tokens, "shift") || holds(tokens, "shifts");
    if (contains(plain, "raman") || (shift && !wavelength)) return unusable;
    for (const std::string_view word : {"depth", "thickness", "distance", "temperature", "mol"}) {
        if (holds(tokens, word) && !wavelength) return unusable;
    }
    if (const auto unit = stated_unit(plain, tokens, wavelength)) return unit;
    if (wavenumber) return in_unit({"", "1/cm", 0, 1e7});
    for (const std::string_view word :
         {"frequency", "freq", "energy", "pixel", "pixels", "px", "channel", "time", "motor"}) {
        if (holds(tokens, word)) return unusable;
    }
    if (wavelength) return Abscissa{.name = "nm"};
    return std::nullopt;
}

bool is_abscissa_name(std::string_view name) {
    const std::string plain = plain_text(name);
    const std::vector<std::string> tokens = tokens_of(plain);
    if (values_stated(name).quantity) return false;
    if (speaks_of_wavenumbers(plain) || speaks_of_wavelengths(tokens)) return true;
    const auto is_unit = [](const std::string& token) {
        return token == "x" || std::ranges::find(units, token, &UnitName::word) != units.end();
    };
    const bool is_letter = tokens.size() == 1 && tokens.front().size() == 1;
    const std::optional<Abscissa> stated = abscissa_stated(name);
    if (!stated || is_letter || !stated->unusable.empty()) return false;
    return std::ranges::all_of(tokens, is_unit) || holds(tokens, "frequency") || holds(tokens, "energy") ||
           stated->name == "1/cm";
}

std::optional<Abscissa> abscissa_in_corner(std::string_view corner) {
    if (is_abscissa_name(corner)) return abscissa_stated(corner);
    for (std::size_t at = corner.find_first_of("\\/|"); at != std::string_view::npos;
         at = corner.find_first_of("\\/|", at + 1)) {
        const std::string_view behind = trimmed(corner.substr(at + 1));
        if (is_abscissa_name(behind)) return abscissa_stated(behind);
    }
    return std::nullopt;
}

std::vector<double> wavelengths_nm(const Abscissa& abscissa, std::span<const double> numbers) {
    std::vector<double> nm(numbers.begin(), numbers.end());
    if (abscissa.is_nm()) return nm;
    for (double& number : nm) {
        number = abscissa.nm_per_unit > 0 ? number * abscissa.nm_per_unit : abscissa.nm_times_unit / number;
    }
    return nm;
}

void refuse_unusable(const Abscissa& abscissa, const std::string& where) {
    if (abscissa.unusable.empty()) return;
    throw InputError(
        {.where = where,
         .problem = fmt::format("the spectrum runs along {}", in_quotes(abscissa.unusable)),
         .why = "that is neither a wavelength nor a wavenumber, frequency or energy of light with its unit",
         .remedy = "export it by wavelength in nm, or name the unit in the header"});
}

}  // namespace skinfit
