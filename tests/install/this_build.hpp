#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/run_program.hpp"

namespace skinfit::test {

/// Runs `words`, the first of which is a program, in `folder` and waits for its end.
[[nodiscard]] Outcome run_words(const std::vector<std::string>& words, const std::filesystem::path& folder);

/// Installs what has been built under `prefix`; a `component` alone where one is named.
[[nodiscard]] Outcome install_build(const std::filesystem::path& prefix, const std::string& component = {});

/// Builds the project at `source` in `folder` as this one has been built, with what is installed under `prefix`.
/// Configuring alone where that fails.
[[nodiscard]] Outcome build_project(const std::filesystem::path& source, const std::filesystem::path& folder,
                                    const std::filesystem::path& prefix);

/// Makes the Debian package in `folder`.
[[nodiscard]] Outcome pack_build(const std::filesystem::path& folder);

/// Whether the file at `path` names the folder of the sources or of the build.
[[nodiscard]] bool names_this_build(const std::filesystem::path& path);

}  // namespace skinfit::test
