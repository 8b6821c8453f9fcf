#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "fit/result.hpp"

namespace skinfit {

/// Measured and modelled spectra with their uncertainties, the residuals below them with the noise, side by side, as
/// the suffix of `name` says: .svg, .png or .pdf; by gnuplot. Throws InputError for another suffix, and when gnuplot is
/// missing or fails.
[[nodiscard]] std::string fit_picture(std::span<const FittedSpectrum> spectra, const std::filesystem::path& name);

}  // namespace skinfit
