#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "measurements/region_choice.hpp"

namespace skinfit {

/// --mask and --rectangle as they were given; empty where not.
struct RegionOptions {
    std::string mask;
    std::string rectangle;
};

/// Adds them to `command`.
void add_region_options(CLI::App& command, RegionOptions& options);

/// What they choose. Throws InputError for a rectangle that is none.
[[nodiscard]] RegionChoice region_from(const RegionOptions& options);

/// The files that reading `file` takes, as far as their names tell: it and the mask, with the mask's header; none of
/// standard input. For `check_output`, before anything is opened; `MeasuredFiles::files_of_cubes` has the rest.
[[nodiscard]] std::vector<std::filesystem::path> files_read(const std::filesystem::path& file,
                                                            const RegionOptions& options = {});

}  // namespace skinfit
