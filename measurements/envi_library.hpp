#pragma once

#include <vector>

#include "measurements/spectral_cube.hpp"
#include "measurements/spectrum.hpp"
#include "measurements/wavelength_window.hpp"

namespace skinfit {

/// The spectra of an ENVI spectral library, which `cube` holds in its lines: those with at least one value, missing
/// values left out and counted, by their `spectra names`. All have one unit: where nothing states it, that of the
/// values in `window`. Throws InputError when none has a value, and as `require_no_radiance`.
[[nodiscard]] std::vector<Spectrum> library_spectra(const SpectralCube& cube, const WavelengthWindow& window = {});

/// Throws InputError where gains of the header give percent that nobody calls percent.
void require_no_radiance(const SpectralCube& cube, const UnitFinding& found);

}  // namespace skinfit
