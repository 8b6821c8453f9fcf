#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/raster.hpp"
#include "measurements/spectral_cube.hpp"

namespace skinfit {

/// Some lines and samples of a picture, counted from 0 at its first line and sample.
struct Rectangle {
    std::size_t first_sample;
    std::size_t first_line;
    std::size_t samples;  ///< above 0
    std::size_t lines;    ///< above 0
};

/// Reads `x,y,width,height`; `where` names the text in messages. Throws InputError for anything else.
[[nodiscard]] Rectangle parse_rectangle(std::string_view text, const std::string& where);

/// Which pixels of a cube to use: those in the rectangle and of the mask; all where neither is given.
struct RegionChoice {
    std::optional<std::filesystem::path> mask{};  ///< ENVI with one band, GeoTIFF or PNG, whose first band counts
    std::optional<Rectangle> rectangle{};
};

/// The chosen pixels of one cube.
class CubeRegion {
public:
    /// Throws InputError when the mask cannot be read or has another size than the cube, and when the rectangle does
    /// not lie within the cube.
    CubeRegion(const RegionChoice& choice, const SpectralCube& cube);

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
