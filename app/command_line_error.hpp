#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "core/input_error.hpp"

namespace skinfit {

/// What is wrong with the command line that `app` refused with `error`, and the closest known command or option.
[[nodiscard]] Complaint command_line_complaint(const CLI::App& app, const CLI::ParseError& error);

/// What is wrong with a `word` that `command` does not know.
[[nodiscard]] Complaint unknown_word(const CLI::App& command, const std::string& word);

/// The help of a command of the program, as its option --help shows it.
[[nodiscard]] std::string help_of(const CLI::App& command);

/// The help of the last command named, where the command line that `app` refused ends before a command that can be run,
/// as `skinfit` and `skinfit study` do; nothing for any other.
[[nodiscard]] std::optional<std::string> help_of_unfinished(const CLI::App& app);

}  // namespace skinfit
