#include "measurements/envi_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/cube_mean.hpp"
#include "measurements/cube_region.hpp"
#include "measurements/envi_files.hpp"
#include "measurements/envi_library.hpp"
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
    if (mean.incomplete > 0) note("pixels_left_out", fmt::format("{} with missing numbers", mean.incomplete));
    if (mean.masked > 0) note("pixels_masked", fmt::to_string(mean.masked));
    if (choice.mask) note("mask", choice.mask->string());
    if (const std::optional<Rectangle>& r = choice.rectangle) {
        note("rectangle", fmt::format("{},{},{},{}", r->first_sample, r->first_line, r->samples, r->lines));
    }
    note("wavelength_unit", header.wavelength_rule);
    return notes;
}

std::optional<std::string> remark_on_pixels(const CubeMean& mean) {
    const std::size_t left_out = mean.masked + mean.incomplete;
    if (left_out == 0) return std::nullopt;
    std::string why;
    if (mean.masked > 0) why = fmt::format("{} have no number, or the same one in all bands, such as 0", mean.masked);
    if (mean.incomplete > 0) {
        why += fmt::format("{}{} lack a number in some band", why.empty() ? "" : ", ", mean.incomplete);
    }
    return fmt::format("{} of {} pixels are left out: {}", left_out, mean.pixels + left_out, why);
}

void take_mean(Spectrum& spectrum, const CubeMean& mean, double one) {
    const std::vector<double> wavelength_nm = std::exchange(spectrum.wavelength_nm, {});
    for (std::size_t i = 0; i < mean.value.size(); ++i) {
        if (std::isnan(mean.value[i])) {
            spectrum.missing_nm.push_back(wavelength_nm[i]);
            continue;
        }
        spectrum.wavelength_nm.push_back(wavelength_nm[i]);
        spectrum.value.push_back(mean.value[i] / one);
        if (!mean.sigma.empty()) spectrum.sigma.push_back(mean.sigma[i] / one);
    }
}

UnitFinding unit_of_mean(const SpectralCube& cube, const std::vector<double>& values) {
    if (cube.has_stated_unit()) return {.unit = Unit::fraction, .rule = cube.unit_rule()};
    UnitFinding found = find_unit({.option = {}, .comment = {}, .header = {}}, values);
    require_no_radiance(cube, found);
    return found;
}

Spectrum mean_of(const SpectralCube& cube, const ReadOptions& options) {
    const CubeMean mean = mean_spectrum(cube, CubeRegion(options.region, cube), options.window);
    Spectrum spectrum = common_spectrum(cube);
    const std::vector<FileNote> notes = notes_on(cube, options.region, mean);
    spectrum.notes.insert(spectrum.notes.begin(), notes.begin(), notes.end());
    if (!mean.sigma.empty()) spectrum.sigma_source = fmt::format("from the scatter of {} pixels", mean.pixels);
    spectrum.remarks = cube.header().remarks;
    spectrum.doubts = cube.header().doubts;
    if (const auto remark = remark_on_pixels(mean)) spectrum.remarks.push_back(*remark);

    const std::vector<double> values = used_values(options.window, cube.wavelength_nm(), mean.value);
    if (values.empty()) {
        throw InputError({.where = cube.files().data.string(),
                          .problem = "is 0 in every band",
                          .why = "no surface reflects nothing",
                          .remedy = "choose another mask or rectangle"});
    }
    const UnitFinding found = unit_of_mean(cube, values);
    spectrum.unit_rule = found.rule;
    take_mean(spectrum, mean, found.unit == Unit::percent ? 100 : 1);
    return spectrum;
}

}  // namespace

Spectrum common_spectrum(const SpectralCube& cube) {
    Spectrum spectrum;
    spectrum.name = cube.files().header.stem().string();
    spectrum.source = cube.files().data.string();
    spectrum.instrument = cube.header().sensor_type;
    spectrum.unit_rule = cube.unit_rule();
    spectrum.quantity = cube.header().quantity;
    spectrum.geometry = cube.header().geometry;
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

std::vector<Spectrum> read_envi(const EnviFiles& files, const ReadOptions& options) {
    const SpectralCube cube(files, options.unit);
    if (!cube.header().spectral_library) return {mean_of(cube, options)};
    if (options.region.mask || options.region.rectangle) {
        throw InputError({.where = cube.header().source,
                          .problem = "is a spectral library",
                          .why = "it has no pixels to choose",
                          .remedy = "leave the mask and the rectangle out"});
    }
    return library_spectra(cube, options.window);
}

}  // namespace skinfit
