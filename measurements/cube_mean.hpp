#pragma once

#include <cstddef>
#include <vector>

#include "measurements/cube_region.hpp"
#include "measurements/spectral_cube.hpp"
#include "measurements/wavelength_window.hpp"

namespace skinfit {

/// The mean spectrum of a region of a cube.
struct CubeMean {
    std::vector<double> value;  ///< one per wavelength of the cube, as fractions; NaN where no pixel has a number but 0
    std::vector<double> sigma;  ///< of `value`: the pixels' standard deviation over the root of their number
    std::size_t pixels;         ///< averaged, at least 1
    std::size_t masked;         ///< left out: pixels of the region without a number in any good band
    std::size_t incomplete;     ///< left out: those without a number in some good band of the window
};

/// Averages the region in one pass over its lines: the pixels that have numbers in all bands of `window`, and in each
/// other band those of them that have a number there. A band that is 0 in every pixel was not measured: no surface
/// reflects nothing. `sigma` is empty for a single pixel and where all pixels agree in some measured band of the
/// window; NaN in bands that were not measured, and in those outside the window where pixels do not differ. Throws
/// InputError when the region holds no pixel that is complete, and when the data cannot be read.
[[nodiscard]] CubeMean mean_spectrum(const SpectralCube& cube, const CubeRegion& region,
                                     const WavelengthWindow& window = {});

}  // namespace skinfit
