#include "study/map_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/input_error.hpp"
#include "measurements/envi_files.hpp"

namespace skinfit {
namespace {

bool is_categorical(const ReducedPlane& plane) {
    return plane.name == "status" || plane.name == "reason";
}

/// The numbers of one line of blocks, block by block; without NaN.
using Blocks = std::vector<std::vector<float>>;

/// Of each plane, from `count` lines.
std::vector<Blocks> read_blocks(const Raster& raster, const EnviHeader& header, std::size_t block, std::size_t first,
                                std::size_t count) {
    std::vector<Blocks> blocks(header.bands, Blocks((header.samples + block - 1) / block));
    for (std::size_t line = first; line < first + count; ++line) {
        const std::vector<double> numbers = raster.read_rows(line * header.bands, header.bands);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (std::isnan(numbers[i])) continue;
            blocks[i / header.samples][i % header.samples / block].push_back(static_cast<float>(numbers[i]));
        }
    }
    return blocks;
}

float mean(const std::vector<float>& numbers) {
    if (numbers.empty()) return std::numeric_limits<float>::quiet_NaN();
    double sum = 0.0;
    for (const float number : numbers) sum += number;
    return static_cast<float>(sum / static_cast<double>(numbers.size()));
}

std::map<float, std::uint64_t> counted(const std::vector<float>& numbers) {
    std::map<float, std::uint64_t> counts;
    for (const float number : numbers) ++counts[number];
    return counts;
}

/// The least of those that are most frequent.
float most_frequent(const std::map<float, std::uint64_t>& counts) {
    const auto found = std::ranges::max_element(counts, {}, [](const auto& each) { return each.second; });
    return found == counts.end() ? std::numeric_limits<float>::quiet_NaN() : found->first;
}

/// `plane` with one more line.
ReducedPlane with_line(ReducedPlane plane, const Blocks& blocks) {
    for (const std::vector<float>& numbers : blocks) {
        if (!is_categorical(plane)) {
            plane.value.push_back(mean(numbers));
            continue;
        }
        const std::map<float, std::uint64_t> counts = counted(numbers);
        plane.value.push_back(most_frequent(counts));
        for (const auto& [number, count] : counts) plane.pixels[number] += count;
    }
    return plane;
}

}  // namespace

ReducedMap reduced_map(const std::filesystem::path& path, std::size_t most) {
    const EnviFiles files = find_envi_files(path);
    const EnviHeader header = read_envi_header(files);
    if (header.interleave != Interleave::bil || header.band_names.empty()) {
        throw InputError({.where = path.string(),
                          .problem = "is no map",
                          .why = "maps are interleaved by line (bil) and name their bands",
                          .remedy = "give a map that skinfit made"});
    }
    const Raster raster = open_envi_data(files, header);
    const std::size_t block = std::max<std::size_t>(1, (std::max(header.samples, header.lines) + most - 1) / most);
    ReducedMap map{.block = block,
                   .samples = (header.samples + block - 1) / block,
                   .lines = (header.lines + block - 1) / block,
                   .pixels = header.samples * header.lines,
                   .planes = {}};
    for (const std::string& name : header.band_names) map.planes.push_back({.name = name, .value = {}});
    for (std::size_t first = 0; first < header.lines; first += block) {
        const std::size_t count = std::min<std::size_t>(block, header.lines - first);
        const std::vector<Blocks> blocks = read_blocks(raster, header, block, first, count);
        for (std::size_t plane = 0; plane < header.bands; ++plane) {
            map.planes[plane] = with_line(std::move(map.planes[plane]), blocks[plane]);
        }
    }
    return map;
}

}  // namespace skinfit
