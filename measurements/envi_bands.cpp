#include "measurements/envi_bands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "measurements/stated_words.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The unit of the wavelengths, and how it was found.
struct WavelengthUnit {
    AbscissaUnit unit;
    std::string rule;
};

/// 0, 1, 2, ... or 1, 2, 3, ...
bool are_band_numbers(const std::vector<double>& wavelengths) {
    if (wavelengths.size() < 2 || (wavelengths.front() != 0 && wavelengths.front() != 1)) return false;
    return std::ranges::adjacent_find(wavelengths, [](double a, double b) { return b != a + 1; }) == wavelengths.end();
}

WavelengthUnit find_unit_of(const EnviFields& fields, const std::vector<double>& wavelengths) {
    constexpr AbscissaUnit nanometres{.factor = 1, .reciprocal = false, .name = "nanometres"};
    constexpr AbscissaUnit micrometres{.factor = 1000, .reciprocal = false, .name = "micrometres"};
    const std::optional<EnviField> field = fields.find("wavelength units");
    const std::string word = field ? lower_case(field->value) : "";
    if (const auto unit = abscissa_unit(word)) {
        return {.unit = *unit, .rule = fmt::format("{}: stated by the header", unit->name)};
    }
    if (!word.empty() && word != "unknown" && word != "none" && word != "n/a") {
        fields.refuse("wavelength units", *field,
                      "it must be a unit of length such as nanometers, of frequency, or wavenumber");
    }
    if (are_band_numbers(wavelengths)) {
        fields.refuse("wavelength", fields.get("wavelength"), "these are the numbers of the bands, no wavelengths");
    }
    constexpr double largest_in_micrometres = 10;
    if (std::ranges::max(wavelengths) > largest_in_micrometres) {
        return {.unit = nanometres, .rule = fmt::format("nanometres: some exceed {}", largest_in_micrometres)};
    }
    return {.unit = micrometres, .rule = fmt::format("micrometres: none exceeds {}", largest_in_micrometres)};
}

}  // namespace

void read_envi_bands(const EnviFields& fields, EnviHeader& header) {
    header.good.assign(header.bands, true);
    const std::vector<double> marks = fields.numbers("bbl", header.bands);
    for (std::size_t band = 0; band < marks.size(); ++band) header.good[band] = marks[band] != 0;

    header.wavelength_nm = fields.numbers("wavelength", header.bands);
    if (header.wavelength_nm.empty()) return;
    header.fwhm_nm = fields.numbers("fwhm", header.bands);
    const WavelengthUnit found = find_unit_of(fields, header.wavelength_nm);
    header.wavelength_rule = found.rule;
    if (found.unit.reciprocal && std::ranges::min(header.wavelength_nm) <= 0) {
        fields.refuse("wavelength", fields.get("wavelength"), fmt::format("{} are above 0", found.unit.name));
    }
    for (std::size_t band = 0; band < header.fwhm_nm.size(); ++band) {
        header.fwhm_nm[band] = found.unit.width_nm(header.wavelength_nm[band], header.fwhm_nm[band]);
    }
    for (double& wavelength : header.wavelength_nm) wavelength = found.unit.wavelength_nm(wavelength);
}

}  // namespace skinfit
