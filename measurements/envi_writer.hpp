#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace skinfit {

/// One picture of a set: a map of something over the pixels.
struct Plane {
    std::string name;          ///< without commas, braces and line ends
    std::vector<float> value;  ///< line after line; NaN where there is none
};

/// Pictures of one size.
struct Planes {
    std::size_t samples = 0;
    std::size_t lines = 0;
    std::string description;    ///< without braces
    std::vector<Plane> planes;  ///< at least one
};

/// Writes an ENVI file of 32-bit numbers, band after band: the data to `path`, then the header beside it, with `hdr` in
/// place of the ending. Each of the two is replaced in one step. (GDAL's own writer replaces neither so.) Throws
/// InputError when they cannot be written or `path` is called like its header.
void write_envi(const std::filesystem::path& path, const Planes& planes);

}  // namespace skinfit
