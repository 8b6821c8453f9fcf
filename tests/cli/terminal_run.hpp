#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/run_program.hpp"

namespace skinfit::test {

/// What happens to the terminal once a text has been shown.
enum class At { control_c, close };

/// Runs skinfit with `arguments` in `folder` with stdout and stderr on a terminal; `out` holds what that showed.
/// `moment`: as soon as it has been shown, `at` happens; empty: never.
[[nodiscard]] Outcome run_on_terminal(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                      const std::string& moment = "", At at = At::control_c);

}  // namespace skinfit::test
