#include "measurements/envi_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/input_error.hpp"
#include "measurements/envi_reader.hpp"
#include "measurements/left_out.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// `values` are those at all wavelengths, spectrum after spectrum.
UnitFinding unit_of_library(const SpectralCube& cube, std::span<const double> values, const WavelengthWindow& window) {
    if (cube.has_stated_unit()) return {.unit = Unit::fraction, .rule = cube.unit_rule()};
    std::vector<double> wavelength_nm;
    for (std::size_t i = 0; i < values.size(); ++i) {
        wavelength_nm.push_back(cube.wavelength_nm()[i % cube.wavelength_nm().size()]);
    }
    const std::vector<double> used = used_values(window, wavelength_nm, values);
    if (used.empty()) return {.unit = Unit::fraction, .rule = cube.unit_rule()};
    UnitFinding found = find_unit({.option = {}, .comment = {}, .header = {}}, used);
    require_no_radiance(cube, found);
    return found;
}

[[noreturn]] void refuse_other(const SpectralCube& cube, const std::string& name, const std::string& quantity) {
    throw InputError({.where = cube.header().source,
                      .problem = fmt::format("{} cannot be used", in_quotes(name)),
                      .why = fmt::format("{} is no reflectance or transmittance", quantity),
                      .remedy = remedy_for(quantity)});
}

/// Makes missing what is the number 0 in the data of all spectra that have numbers, as where a band was not measured:
/// no surface reflects nothing. Gives how many bands these are.
std::size_t take_out_dead_bands(const SpectralCube& cube, std::span<double> values) {
    const std::size_t count = cube.bands().size();
    std::size_t dead = 0;
    for (std::size_t band = 0; band < count; ++band) {
        bool is_zero = false;
        bool is_other = false;
        for (std::size_t i = band; i < values.size(); i += count) {
            is_zero = is_zero || values[i] == cube.fraction_of_zero(band);
            is_other = is_other || (!std::isnan(values[i]) && values[i] != cube.fraction_of_zero(band));
        }
        if (!is_zero || is_other) continue;
        ++dead;
        for (std::size_t i = band; i < values.size(); i += count) values[i] = std::numeric_limits<double>::quiet_NaN();
    }
    return dead;
}

}  // namespace

std::vector<Spectrum> library_spectra(const SpectralCube& cube, const WavelengthWindow& window) {
    std::vector<double> values;
    for (std::size_t first = 0; first < cube.lines(); first += cube.lines_at_once()) {
        const std::vector<double> part = cube.read_lines(first, std::min(cube.lines_at_once(), cube.lines() - first));
        values.insert(values.end(), part.begin(), part.end());
    }
    const std::size_t dead = take_out_dead_bands(cube, values);
    const UnitFinding unit = unit_of_library(cube, values, window);
    const std::size_t count = cube.bands().size();
    Grid grid{.wavelength_nm = cube.wavelength_nm(), .order = {}, .repeated = common_spectrum(cube).repeated};
    for (std::size_t i = 0; i < count; ++i) grid.order.push_back(i);

    const std::vector<std::string>& names = cube.header().spectra_names;
    std::vector<Spectrum> spectra;
    LeftOut left_out;
    std::size_t without_numbers = 0;
    for (std::size_t line = 0; line < cube.lines(); ++line) {
        Spectrum spectrum = common_spectrum(cube);
        spectrum.wavelength_nm.clear();
        spectrum.remarks = cube.header().remarks;
        spectrum.doubts = cube.header().doubts;
        spectrum.name = names.empty() ? fmt::format("spectrum {}", line + 1) : names[line];
        if (const auto stated = specular_stated(spectrum.name)) spectrum.geometry.specular = stated;
        if (const auto stated = values_stated(spectrum.name).quantity) spectrum.quantity = stated;
        if (const auto other = unusable_in_prose(spectrum.name)) {
            left_out.or_keep_error([&] { refuse_other(cube, spectrum.name, *other); });
            continue;
        }
        spectrum.notes.push_back({.line = 0, .key = "wavelength_unit", .value = cube.header().wavelength_rule});
        take_readings(spectrum, grid, {.value = std::span(values).subspan(line * count, count)}, unit);
        if (dead > 0) {
            spectrum.remarks.push_back(fmt::format("{} band{} of the file {} 0 in all spectra and {} as not measured",
                                                   dead, dead == 1 ? "" : "s", dead == 1 ? "is" : "are",
                                                   dead == 1 ? "counts" : "count"));
        }
        if (spectrum.value.empty()) {
            ++without_numbers;
        } else {
            spectra.push_back(std::move(spectrum));
        }
    }
    left_out.tell(spectra);
    if (spectra.empty()) {
        throw InputError({.where = cube.files().data.string(),
                          .problem = "holds no spectra",
                          .why = "each of its lines is without numbers, or one and the same number",
                          .remedy = "check that it is the data of this header"});
    }
    if (without_numbers > 0) {
        for (Spectrum& spectrum : spectra) {
            spectrum.remarks.push_back(fmt::format("{} of {} spectra of the file are without numbers and are left out",
                                                   without_numbers, cube.lines()));
        }
    }
    return spectra;
}

void require_no_radiance(const SpectralCube& cube, const UnitFinding& found) {
    const EnviHeader& header = cube.header();
    if (found.unit != Unit::percent || (header.gain.empty() && header.data_offset.empty())) return;
    throw InputError({.where = header.source,
                      .problem = fmt::format("gives values above {} by its gains and offsets", largest_fraction),
                      .why = "they may be radiances, which are no shares of light, or percent",
                      .remedy = "if they are percent, give --unit percent; " + remedy_for("radiance")});
}

}  // namespace skinfit
