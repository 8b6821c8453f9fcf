#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectral_cube.hpp"
#include "measurements/spectrum.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {

/// By which `--reader` and messages call it.
inline constexpr std::string_view envi_reader_name = "envi";

/// What the spectra of all pixels of `cube` share, without values: name, source, instrument, unit, wavelengths and
/// bandpass, a Gaussian of the bands' mean `fwhm`.
[[nodiscard]] Spectrum common_spectrum(const SpectralCube& cube);

/// The spectra of an ENVI file: of a spectral library all (`library_spectra`), of a cube the mean over the pixels of
/// `options.region`. Its sigma is the scatter of the pixels over the root of their number, the rest that of
/// `common_spectrum`; notes state the pixels, the region, the unit of the wavelengths and the spread of `fwhm`, remarks
/// what was left out.
///
/// Unit: `SpectralCube`; where neither the header nor an option states one, `find_unit` for the mean.
///
/// Throws InputError as `SpectralCube`, `CubeRegion` and `mean_spectrum`; when no band has a value other than 0; for
/// values that by the header's gains exceed `largest_fraction` and are not stated to be percent: they may be radiances;
/// and for a region of a library.
[[nodiscard]] std::vector<Spectrum> read_envi(const EnviFiles& files, const ReadOptions& options = {});

}  // namespace skinfit
