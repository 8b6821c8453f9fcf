#include "app/region_options.hpp"

#include "app/measured_file.hpp"

namespace skinfit {

void add_region_options(CLI::App& command, RegionOptions& options) {
    command
        .add_option(
            "--mask", options.mask,
            "of an ENVI cube, average the pixels that are not 0 in this ENVI, GeoTIFF or PNG file; all if not given")
        ->type_name("FILE");
    command
        .add_option("--rectangle", options.rectangle,
                    "of an ENVI cube, average the pixels in this rectangle; X counts samples (columns), Y lines "
                    "(rows), both from 0; all if not given")
        ->type_name("X,Y,WIDTH,HEIGHT");
}

RegionChoice region_from(const RegionOptions& options) {
    RegionChoice region;
    if (!options.mask.empty()) region.mask = options.mask;
    if (!options.rectangle.empty()) region.rectangle = parse_rectangle(options.rectangle, "--rectangle");
    return region;
}

std::vector<std::filesystem::path> files_read(const std::filesystem::path& file, const RegionOptions& options) {
    if (is_standard_input(file.string())) return {};
    std::vector<std::filesystem::path> files{file};
    if (options.mask.empty()) return files;
    files.emplace_back(options.mask);
    files.emplace_back(options.mask + ".hdr");
    files.push_back(std::filesystem::path(options.mask).replace_extension(".hdr"));
    return files;
}

}  // namespace skinfit
