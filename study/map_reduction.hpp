#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace skinfit {

/// One plane of a map at the size of a picture.
struct ReducedPlane {
    std::string name;
    /// Line after line: the mean of the numbers in each block of pixels; of `status` and `reason` the most frequent.
    /// NaN where the block has none.
    std::vector<float> value;
    /// Of `status` and `reason`: how many pixels of the whole map have each number; empty for the others.
    std::map<float, std::uint64_t> pixels{};
};

/// A map at the size of a picture.
struct ReducedMap {
    std::size_t block = 1;    ///< pixels of the map in each direction that become one of the picture
    std::size_t samples = 0;  ///< of the picture
    std::size_t lines = 0;
    std::uint64_t pixels = 0;  ///< of the whole map
    std::vector<ReducedPlane> planes;
};

/// The map in the ENVI file `path`, reduced by the least whole number that makes it at most `most` samples and lines.
/// Of the map, one line of all planes is in memory at a time. Throws InputError as the reader of ENVI files, and where
/// it is none that `EnviWriter` wrote for a map: interleave bil, with named bands.
[[nodiscard]] ReducedMap reduced_map(const std::filesystem::path& path, std::size_t most);

}  // namespace skinfit
