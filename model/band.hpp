#pragma once

#include <vector>

namespace skinfit {

/// What the wavelengths of a band weigh.
enum class BandIlluminant {
    equal_energy,
    d65,    ///< CIE standard illuminant D65
    d65_v,  ///< D65 times the luminous efficiency V(lambda): what the eye makes of daylight
};

/// The weight of each wavelength, up to a common factor: one term each of a sum over a grid of even steps, as in
/// [CIE15]. Throws InputError for a wavelength outside the illuminant's table.
[[nodiscard]] std::vector<double> band_weights(const std::vector<double>& wavelengths_nm, BandIlluminant illuminant);

}  // namespace skinfit
