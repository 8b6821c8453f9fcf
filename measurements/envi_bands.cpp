#include "measurements/envi_bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/geometry.hpp"
#include "measurements/abscissa.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The unit of the wavelengths, and how it was found.
struct WavelengthUnit {
    Abscissa unit;
    std::string rule;
};

WavelengthUnit stated_by(const Abscissa& unit, std::string_view by) {
    return {.unit = unit, .rule = fmt::format("{}: stated by {}", unit.name, by)};
}

/// 0, 1, 2, ... or 1, 2, 3, ...
bool are_band_numbers(const std::vector<double>& wavelengths) {
    if (wavelengths.size() < 2 || (wavelengths.front() != 0 && wavelengths.front() != 1)) return false;
    return std::ranges::adjacent_find(wavelengths, [](double a, double b) { return b != a + 1; }) == wavelengths.end();
}

bool are_possible(const Abscissa& unit, const std::vector<double>& wavelengths) {
    return std::ranges::find(wavelengths, 0.0) == wavelengths.end() &&
           std::ranges::all_of(wavelengths_nm(unit, wavelengths),
                               [](double nm) { return wavelength_range_nm.contains(nm); });
}

/// The first of the titles of a plot is that of its abscissa; a unit there by which the wavelengths are possible.
std::optional<Abscissa> unit_in_title(const EnviFields& fields, const std::vector<double>& wavelengths) {
    const std::optional<EnviField> titles = fields.find("z plot titles");
    if (!titles) return std::nullopt;
    const std::optional<Abscissa> stated = abscissa_stated(titles->value.substr(0, titles->value.find(',')));
    const bool is_unit = stated && stated->named_by_unit && stated->unusable.empty();
    return is_unit && are_possible(*stated, wavelengths) ? stated : std::nullopt;
}

/// `behind` is the word that stands behind each number of the list, as in `400 nm`.
WavelengthUnit find_unit_of(const EnviFields& fields, const std::vector<double>& wavelengths,
                            const std::string& behind) {
    const std::optional<EnviField> field = fields.find("wavelength units");
    const std::string word = field ? lower_case(field->value) : "";
    const std::optional<Abscissa> in_list = behind.empty() ? std::nullopt : abscissa_in_unit(behind);
    if (!behind.empty() && !in_list) {
        fields.refuse("wavelength", fields.get("wavelength"), fmt::format("{} is no unit", in_quotes(behind)));
    }
    if (const auto unit = abscissa_in_unit(word)) {
        if (in_list && in_list->name != unit->name) {
            fields.refuse("wavelength units", *field, fmt::format("the wavelengths themselves are in {}", behind));
        }
        return stated_by(*unit, "the header");
    }
    if (!word.empty() && word != "unknown" && word != "none" && word != "n/a") {
        fields.refuse("wavelength units", *field,
                      "it must be a unit of length such as nanometers, of frequency, or wavenumber");
    }
    if (in_list) return stated_by(*in_list, "the header");
    if (are_band_numbers(wavelengths)) {
        fields.refuse("wavelength", fields.get("wavelength"), "these are the numbers of the bands, no wavelengths");
    }
    if (const auto unit = unit_in_title(fields, wavelengths)) return stated_by(*unit, "\"z plot titles\"");
    constexpr double largest_in_micrometres = 10;
    if (std::ranges::max(wavelengths) > largest_in_micrometres) {
        return {.unit = Abscissa{.name = "nm"},
                .rule = fmt::format("nanometres: some exceed {}", largest_in_micrometres)};
    }
    return {.unit = Abscissa{.name = "um", .nm_per_unit = 1000},
            .rule = fmt::format("micrometres: none exceeds {}", largest_in_micrometres)};
}

}  // namespace

void read_envi_bands(const EnviFields& fields, EnviHeader& header) {
    header.good.assign(header.bands, true);
    const std::vector<double> marks = fields.numbers("bbl", header.bands);
    for (std::size_t band = 0; band < marks.size(); ++band) header.good[band] = marks[band] != 0;

    std::string behind;
    header.wavelength_nm = fields.numbers("wavelength", header.bands, &behind);
    if (header.wavelength_nm.empty()) return;
    std::string behind_width;
    header.fwhm_nm = fields.numbers("fwhm", header.bands, &behind_width);
    if (!behind_width.empty() && behind_width != behind) {
        fields.refuse("fwhm", fields.get("fwhm"), "the wavelengths have another unit behind them, or none");
    }
    const WavelengthUnit found = find_unit_of(fields, header.wavelength_nm, behind);
    header.wavelength_rule = found.rule;
    const bool reciprocal = found.unit.nm_times_unit > 0;
    if (reciprocal && std::ranges::min(header.wavelength_nm) <= 0) {
        fields.refuse("wavelength", fields.get("wavelength"),
                      fmt::format("numbers in {} are above 0", found.unit.name));
    }
    for (std::size_t band = 0; band < header.fwhm_nm.size(); ++band) {
        header.fwhm_nm[band] = width_nm(found.unit, header.wavelength_nm[band], header.fwhm_nm[band]);
    }
    header.wavelength_nm = wavelengths_nm(found.unit, header.wavelength_nm);
}

}  // namespace skinfit
