#include "measurements/cube_region.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/input_error.hpp"
#include "measurements/envi_files.hpp"

namespace skinfit {
namespace {

Raster open_mask(const std::filesystem::path& path) {
    const std::optional<EnviFiles> files = envi_files(path);
    if (!files) return Raster(path);
    const EnviHeader header = read_envi_header(*files);
    if (header.bands != 1) {
        throw InputError({.where = header.source,
                          .problem = fmt::format("has {} bands", header.bands),
                          .why = "a mask has one",
                          .remedy = "export the mask alone"});
    }
    if (!header.doubts.empty()) {
        throw InputError({.where = header.source,
                          .problem = "is in doubt as a mask",
                          .why = header.doubts.front().message,
                          .remedy = header.doubts.front().remedy});
    }
    return open_envi_data(*files, header);
}

std::optional<Raster> mask_for(const SpectralCube& cube, const std::optional<std::filesystem::path>& path) {
    if (!path) return std::nullopt;
    Raster mask = open_mask(*path);
    if (mask.columns() != cube.samples() || mask.rows() != cube.lines()) {
        throw InputError({.where = path->string(),
                          .problem = fmt::format("has {} x {} pixels", mask.columns(), mask.rows()),
                          .why = fmt::format("the cube has {} x {}", cube.samples(), cube.lines()),
                          .remedy = "give a mask of the same size as the cube"});
    }
    return mask;
}

Rectangle rectangle_in(const SpectralCube& cube, const std::optional<Rectangle>& chosen) {
    if (!chosen) return {.first_sample = 0, .first_line = 0, .samples = cube.samples(), .lines = cube.lines()};
    const bool inside = chosen->first_sample < cube.samples() && chosen->first_line < cube.lines() &&
                        chosen->samples <= cube.samples() - chosen->first_sample &&
                        chosen->lines <= cube.lines() - chosen->first_line;
    if (inside) return *chosen;
    throw InputError(
        {.where = fmt::format("the rectangle {},{},{},{}", chosen->first_sample, chosen->first_line, chosen->samples,
                              chosen->lines),
         .problem = "reaches beyond the cube",
         .why = fmt::format("{} has {} x {} pixels", cube.files().data.string(), cube.samples(), cube.lines()),
         .remedy = "give x,y,width,height within it, counted from 0"});
}

}  // namespace

CubeRegion::CubeRegion(const RegionChoice& choice, const SpectralCube& cube)
    : samples_(cube.samples()), rectangle_(rectangle_in(cube, choice.rectangle)), mask_(mask_for(cube, choice.mask)) {}

std::vector<bool> CubeRegion::read_lines(std::size_t first, std::size_t count) const {
    std::vector<bool> chosen(count * samples_, false);
    const std::vector<double> mask = mask_ ? mask_->read_rows(first, count) : std::vector<double>{};
    for (std::size_t line = 0; line < count; ++line) {
        if (first + line < rectangle_.first_line || first + line - rectangle_.first_line >= rectangle_.lines) continue;
        for (std::size_t i = 0; i < rectangle_.samples; ++i) {
            const std::size_t pixel = line * samples_ + rectangle_.first_sample + i;
            chosen[pixel] = mask.empty() || (mask[pixel] != 0 && !std::isnan(mask[pixel]));
        }
    }
    return chosen;
}

}  // namespace skinfit
