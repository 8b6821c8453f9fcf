#pragma once

#include <CLI/CLI.hpp>

#include "core/input_error.hpp"

namespace skinfit {

/// What is wrong with the command line that `app` refused with `error`, and the closest known command or option.
[[nodiscard]] Complaint command_line_complaint(const CLI::App& app, const CLI::ParseError& error);

}  // namespace skinfit
