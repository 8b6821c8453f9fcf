#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "measurements/cube_region.hpp"
#include "measurements/spectral_cube.hpp"
#include "study/fit_status.hpp"
#include "study/pixel_fitter.hpp"

namespace skinfit {

/// The planes of a map, in their order: the value and then the sigma of each free parameter (`oxygen_saturation`,
/// `oxygen_saturation_sigma`), then `status` and `reason`, numbers of `FitStatus` and `PixelReason`, `rmse` and `chi2`.
[[nodiscard]] std::vector<std::string> map_planes(const FitProblem& problem);

/// The map of some whole lines of a cube. The bytes of all tiles of a cube, one after the other, are the data of its
/// map.
struct MapTile {
    /// For each line, for each plane, a 32-bit floating point number for each pixel, in the machine's byte order; NaN
    /// where there is none. Of a pixel that is masked, which those without any number in the cube are too, only the
    /// status is a number.
    std::string bytes;
    std::array<std::uint64_t, fit_status_names.size()> pixels{};  ///< with each status
};

/// How many lines a tile of `cube` has, but for the last: some 8000 pixels or one line, which takes a second or two to
/// fit, and no more than `SpectralCube::lines_at_once`. Depends on the cube alone.
[[nodiscard]] std::size_t tile_lines(const SpectralCube& cube);

/// Fits the pixels of `region` in `count` lines of `cube` from line `first` on, in parallel: the same bytes on any
/// number of threads and however the cube is cut into tiles. `fitter` must have been made for the wavelengths of
/// `cube`. Throws InputError when cube or mask cannot be read.
[[nodiscard]] MapTile fit_tile(const PixelFitter& fitter, const SpectralCube& cube, const CubeRegion& region,
                               std::size_t first, std::size_t count);

}  // namespace skinfit
