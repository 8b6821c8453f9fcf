#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// How the values of many spectra are distributed at each wavelength.
struct QuantileBand {
    std::vector<double> wavelength_nm;  ///< all that occur, or 256 of them evenly spaced where there are more
    std::vector<double> low;            ///< 5 % quantile of the spectra that reach this wavelength
    std::vector<double> median;
    std::vector<double> high;  ///< 95 % quantile
};

/// The band of at least one spectrum; values between readings are interpolated.
[[nodiscard]] QuantileBand quantile_band(std::span<const Spectrum> spectra);

/// The spectra drawn for a terminal: as lines, or as their median and a band where there are many.
[[nodiscard]] std::string terminal_plot_of(std::span<const Spectrum> spectra);

/// The same as a picture with `title`, an .svg, .png or .pdf by the suffix of `path`, with the errors of
/// `draw(Plot, path)`.
void draw_spectra(std::span<const Spectrum> spectra, const std::string& title, const std::filesystem::path& path);

}  // namespace skinfit
