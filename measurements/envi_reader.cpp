#include "measurements/envi_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/cube_mean.hpp"
#include "measurements/cube_region.hpp"
#include "measurements/envi_files.hpp"
#include "measurements/spectral_cube.hpp"
#include "measurements/unit_rule.hpp"

namespace skinfit {
namespace {

/// The widths of the good bands; none where the header does not give all of them.
std::vector<double> widths_of(const SpectralCube& cube) {
    if (cube.header().fwhm_nm.empty()) return {};
    std::vector<double> widths;
    for (const std::size_t band : cube.bands()) widths.push_back(cube.header().fwhm_nm[band]);
    return std::ranges::min(widths) > 0 ? widths : std::vector<double>{};
}

void take_bandpass(Spectrum& spectrum, const std::vector<double>& widths) {
    if (widths.empty()) return;
    const auto [narrowest, widest] = std::ranges::minmax(widths);
    if (widest > bandpass_width_range_nm.highest) {
        throw InputError({.where = spectrum.source,
                          .problem = fmt::format("has a band of {:g} nm (fwhm)", widest),
                          .why = fmt::format("at most {} nm are modelled", bandpass_width_range_nm.highest),
                          .remedy = "correct fwhm in the header, or leave it out"});
    }
    const double sum = std::accumulate(widths.begin(), widths.end(), 0.0);
    spectrum.bandpass =
        Bandpass{.shape = BandpassShape::gaussian, .width_nm = sum / static_cast<double>(widths.size())};
    spectrum.notes.push_back({.line = 0, .key = "fwhm_nm", .value = fmt::format("{} to {}", narrowest, widest)});
}

std::vector<FileNote> notes_on(const SpectralCube& cube, const RegionChoice& choice, const CubeMean& mean) {
    const EnviHeader& header = cube.header();
    std::vector<FileNote> notes;
    const auto note = [&notes](const std::string& key, const std::string& value) {
        notes.push_back({.line = 0, .key = key, .value = value});
    };
    note("cube", fmt::format("{} x {} pixels, {} of {} bands, {}", cube.samples(), cube.lines(), cube.bands().size(),
                             header.bands, interleave_names[static_cast<std::size_t>(header.interleave)]));
    note("pixels", fmt::to_string(mean.pixels));
    if (mean.left_out > 0) note("pixels_left_out", fmt::format("{} with missing numbers", mean.left_out));
    if (choice.mask) note("mask", choice.mask->string());
    if (const std::optional<Rectangle>& r = choice.rectangle) {
        note("rectangle", fmt::format("{},{},{},{}", r->first_sample, r->first_line, r->samples, r->lines));
    }
    note("wavelength_unit", header.wavelength_rule);
    return notes;
}

/// The numbers in the window; all of them where it has none.
std::vector<double> used_values(const WavelengthWindow& window, const std::vector<double>& wavelength_nm,
                                const std::vector<double>& value) {
    std::vector<double> present;
    std::vector<double> used;
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (std::isnan(value[i])) continue;
        present.push_back(value[i]);
        if (window.contains(wavelength_nm[i])) used.push_back(value[i]);
    }
    return used.empty() ? present : used;
}

}  // namespace

Spectrum common_spectrum(const SpectralCube& cube) {
    Spectrum spectrum;
    spectrum.name = cube.files().header.stem().string();
    spectrum.source = cube.files().data.string();
    spectrum.instrument = cube.header().sensor_type;
    spectrum.unit_rule = cube.unit_rule();
    spectrum.wavelength_nm = cube.wavelength_nm();
    for (std::size_t i = 1; i < cube.bands().size(); ++i) {
        if (spectrum.wavelength_nm[i] != spectrum.wavelength_nm[i - 1]) continue;
        spectrum.repeated.push_back({.wavelength_nm = spectrum.wavelength_nm[i],
                                     .where = fmt::format("{}: band {}", cube.header().source, cube.bands()[i] + 1),
                                     .first = fmt::format("band {}", cube.bands()[i - 1] + 1)});
    }
    take_bandpass(spectrum, widths_of(cube));
    return spectrum;
}

Spectrum read_envi(const EnviFiles& files, const ReadOptions& options) {
    const SpectralCube cube(files, options.unit);
    const CubeMean mean = mean_spectrum(cube, CubeRegion(options.region, cube), options.window);

    Spectrum spectrum = common_spectrum(cube);
    const std::vector<FileNote> notes = notes_on(cube, options.region, mean);
    spectrum.notes.insert(spectrum.notes.begin(), notes.begin(), notes.end());
    if (!mean.sigma.empty()) spectrum.sigma_source = fmt::format("from the scatter of {} pixels", mean.pixels);

    const bool stated = options.unit || cube.header().reflectance_scale_factor;
    const UnitFinding found = stated ? UnitFinding{.unit = Unit::fraction, .rule = cube.unit_rule()}
                                     : find_unit({.option = {}, .comment = {}, .header = {}},
                                                 used_values(options.window, cube.wavelength_nm(), mean.value));
    const double one = found.unit == Unit::percent ? 100 : 1;
    spectrum.unit_rule = found.rule;
    spectrum.wavelength_nm.clear();
    for (std::size_t i = 0; i < mean.value.size(); ++i) {
        if (std::isnan(mean.value[i])) {
            spectrum.missing_nm.push_back(cube.wavelength_nm()[i]);
            continue;
        }
        spectrum.wavelength_nm.push_back(cube.wavelength_nm()[i]);
        spectrum.value.push_back(mean.value[i] / one);
        if (!mean.sigma.empty()) spectrum.sigma.push_back(mean.sigma[i] / one);
    }
    return spectrum;
}

}  // namespace skinfit
