#include "study/cube_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/input_error.hpp"
#include "measurements/envi_reader.hpp"
#include "study/map_file.hpp"
#include "study/map_preview.hpp"
#include "study/map_tile.hpp"
#include "study/study_run.hpp"

namespace skinfit {
namespace {

/// Size and time of the last change.
std::string stamp_of(const std::filesystem::path& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    const auto time = std::filesystem::last_write_time(path, error).time_since_epoch().count();
    return fmt::format("{} {};", size, time);
}

std::string hash_of(const StudyCube& cube, const SpectralCube& opened) {
    std::string text = opened.files().header_text + stamp_of(opened.files().data);
    text += cube.unit ? std::string(unit_names[static_cast<std::size_t>(*cube.unit)]) : std::string();
    if (cube.region.mask) text += stamp_of(*cube.region.mask);
    if (const std::optional<Rectangle>& rectangle = cube.region.rectangle) {
        text += fmt::format("{} {} {} {}", rectangle->first_sample, rectangle->first_line, rectangle->samples,
                            rectangle->lines);
    }
    return content_hash(text);
}

/// Throws InputError where there is no picture, or every pixel would be in doubt.
void require_picture(const EnviHeader& header) {
    if (header.spectral_library) {
        throw InputError({.where = header.source,
                          .problem = "is a spectral library",
                          .why = "it has no pixels to make a map of",
                          .remedy = "list it among the spectra of the study"});
    }
    if (header.doubts.empty()) return;
    throw InputError({.where = header.source,
                      .problem = "gives no map",
                      .why = header.doubts.front().message,
                      .remedy = header.doubts.front().remedy});
}

}  // namespace

std::string map_name(const std::string& source) {
    std::string name = std::filesystem::path(source).replace_extension().string();
    std::ranges::replace_if(
        name, [](char c) { return c == '/' || c == ' '; }, '_');
    return name + "_map.dat";
}

CubeEntry planned(StudyReader& reader, std::size_t number) {
    const StudyCube& cube = reader.study().cubes[number];
    CubeEntry entry;
    entry.source = cube.source;
    entry.metadata = cube.metadata;
    try {
        const SpectralCube opened(reader.files_of_cube(number), cube.unit);
        require_picture(opened.header());
        const CubeRegion region(cube.region, opened);
        entry.input_hash = hash_of(cube, opened);
        entry.samples = opened.samples();
        const std::size_t step = tile_lines(opened);
        for (std::size_t first = 0; first < opened.lines(); first += step) {
            entry.tiles.push_back({.first_line = first, .lines = std::min(step, opened.lines() - first)});
        }
    } catch (const InputError& error) {
        entry.problem = error.what();
        entry.input_hash = content_hash(error.what());
    }
    return entry;
}

std::optional<std::string> write_map(const Ledger& ledger, StudyReader& reader, std::size_t number,
                                     const DiskCache& cache) {
    const Study& study = reader.study();
    const StudyCube& cube = study.cubes[number];
    const SpectralCube opened(reader.files_of_cube(number), cube.unit);
    const PixelFitter fitter(study.configuration, common_spectrum(opened), cache);
    const std::filesystem::path folder = study.output / "maps";
    make_folder(folder, folder.string());
    const std::filesystem::path map = folder / map_name(cube.source);
    EnviWriter writer(map, map_output(fitter.problem(), opened, configuration_hash_of(study)));
    for_each_tile(ledger, cube.source, [&](const FittedTile& tile) { writer.append(tile.bytes); });
    writer.finish();
    try {
        (void)draw_map(map, folder);
    } catch (const InputError& error) {
        return error.what();
    }
    const std::filesystem::path from = std::filesystem::absolute(ledger.path()).parent_path();
    finish_cube(ledger, cube.source, std::filesystem::absolute(map).lexically_relative(from).string());
    return std::nullopt;
}

}  // namespace skinfit
