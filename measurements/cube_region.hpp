#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "measurements/raster.hpp"
#include "measurements/region_choice.hpp"
#include "measurements/spectral_cube.hpp"

namespace skinfit {

/// The chosen pixels of one cube.
class CubeRegion {
public:
    /// Throws InputError when the mask cannot be read or has another size than the cube, and when the rectangle does
    /// not lie within the cube.
    CubeRegion(const RegionChoice& choice, const SpectralCube& cube);

    /// The part of the image in which it lies.
    [[nodiscard]] const Rectangle& rectangle() const { return rectangle_; }

    /// For each pixel of `count` lines from line `first` on, whether it is chosen. A pixel of the mask is chosen when
    /// its number is neither 0 nor NaN. Throws InputError when the mask cannot be read.
    [[nodiscard]] std::vector<bool> read_lines(std::size_t first, std::size_t count) const;

private:
    std::size_t samples_;
    Rectangle rectangle_;
    std::optional<Raster> mask_;
};

}  // namespace skinfit
