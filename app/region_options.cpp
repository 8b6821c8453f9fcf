#include "app/region_options.hpp"

#include "app/measured_file.hpp"
#include "measurements/envi_files.hpp"

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
    if (!options.mask.empty()) files.emplace_back(options.mask);
    for (std::size_t i = 0, named = files.size(); i < named; ++i) {
        if (!find_envi_header(files[i])) continue;
        const EnviFiles both = find_envi_files(files[i]);
        files.push_back(both.header);
        files.push_back(both.data);
    }
    return files;
}

}  // namespace skinfit
