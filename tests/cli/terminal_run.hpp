#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/run_program.hpp"

namespace skinfit::test {

/// Runs skinfit with `arguments` in `folder` with stdout and stderr on a terminal; `out` holds what that showed.
/// `interrupt_at`: as soon as it has been shown, Ctrl-C is typed; empty: never.
[[nodiscard]] Outcome run_on_terminal(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                      const std::string& interrupt_at = "");

}  // namespace skinfit::test
