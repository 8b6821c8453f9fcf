#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// What the commands are, as the manual and the completion of shells need it.
namespace skinfit {

/// One option or positional argument of a command.
struct OptionWords {
    std::vector<std::string> names;    ///< with their dashes; none: positional
    std::string argument;              ///< the placeholder of its value; empty: it takes none
    std::vector<std::string> choices;  ///< where the value is one of these
    std::string default_text;          ///< empty: none
    std::string meaning;
    bool required;
    bool repeats;
};

/// One command, with all its subcommands.
struct CommandWords {
    std::string name;  ///< as in "study run"; empty: the program itself
    std::string meaning;
    std::string footer;
    std::vector<OptionWords> options;  ///< in the order of the help
    std::vector<CommandWords> commands;
};

[[nodiscard]] CommandWords command_words(const CLI::App& app);

/// All commands that can be run, in order.
[[nodiscard]] std::vector<CommandWords> leaves(const CommandWords& command);

}  // namespace skinfit
