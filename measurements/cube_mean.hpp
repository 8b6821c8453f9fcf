#pragma once

#include <cstddef>
#include <vector>

#include "measurements/cube_region.hpp"
#include "measurements/spectral_cube.hpp"

namespace skinfit {

/// The mean spectrum of a region of a cube.
struct CubeMean {
    std::vector<double> value;  ///< one per wavelength of the cube, as fractions; NaN where all pixels are 0
    std::vector<double> sigma;  ///< of `value`: the pixels' standard deviation over the root of their number
    std::size_t pixels;         ///< averaged, at least 1
    std::size_t masked;         ///< left out: pixels of the region without a number in any good band
    std::size_t incomplete;     ///< left out: those without a number in some good band
};

/// Averages the region in one pass over its lines. `sigma` is empty for a single pixel and where all pixels agree in
/// some band, those of NaN apart. A band that is 0 in every pixel was not measured: no surface reflects nothing. Throws
/// InputError when the region holds no pixel that is complete, and when the data cannot be read.
[[nodiscard]] CubeMean mean_spectrum(const SpectralCube& cube, const CubeRegion& region);

}  // namespace skinfit
