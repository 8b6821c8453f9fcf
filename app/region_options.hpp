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

/// The files that reading `file` takes: both of a cube's, where it is one of them, and the mask; none of standard
/// input. For `check_output`. Throws InputError where a cube lacks its data.
[[nodiscard]] std::vector<std::filesystem::path> files_read(const std::filesystem::path& file,
                                                            const RegionOptions& options = {});

}  // namespace skinfit
