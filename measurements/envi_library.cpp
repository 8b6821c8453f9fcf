#include "measurements/envi_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/input_error.hpp"
#include "measurements/envi_reader.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/stated_words.hpp"

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

}  // namespace

std::vector<Spectrum> library_spectra(const SpectralCube& cube, const WavelengthWindow& window) {
    std::vector<double> values;
    for (std::size_t first = 0; first < cube.lines(); first += cube.lines_at_once()) {
        const std::vector<double> part = cube.read_lines(first, std::min(cube.lines_at_once(), cube.lines() - first));
        values.insert(values.end(), part.begin(), part.end());
    }
    const UnitFinding unit = unit_of_library(cube, values, window);
    const std::size_t count = cube.bands().size();
    Grid grid{.wavelength_nm = cube.wavelength_nm(), .order = {}, .repeated = common_spectrum(cube).repeated};
    for (std::size_t i = 0; i < count; ++i) grid.order.push_back(i);

    const std::vector<std::string>& names = cube.header().spectra_names;
    std::vector<Spectrum> spectra;
    for (std::size_t line = 0; line < cube.lines(); ++line) {
        Spectrum spectrum = common_spectrum(cube);
        spectrum.wavelength_nm.clear();
        spectrum.remarks = cube.header().remarks;
        spectrum.doubts = cube.header().doubts;
        spectrum.name = names.empty() ? fmt::format("spectrum {}", line + 1) : names[line];
        spectrum.geometry.specular = specular_in_title(spectrum.name);
        spectrum.notes.push_back({.line = 0, .key = "wavelength_unit", .value = cube.header().wavelength_rule});
        take_readings(spectrum, grid, {.value = std::span(values).subspan(line * count, count)}, unit);
        if (!spectrum.value.empty()) spectra.push_back(std::move(spectrum));
    }
    if (spectra.empty()) {
        throw InputError({.where = cube.files().data.string(),
                          .problem = "holds no spectra",
                          .why = "each of its lines is without numbers, or one and the same number",
                          .remedy = "check that it is the data of this header"});
    }
    if (const std::size_t left_out = cube.lines() - spectra.size(); left_out > 0) {
        for (Spectrum& spectrum : spectra) {
            spectrum.remarks.push_back(fmt::format("{} of {} spectra of the file are without numbers and are left out",
                                                   left_out, cube.lines()));
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
