#pragma once

#include <string>
#include <vector>

#include "app/command_tree.hpp"

namespace skinfit {

/// What can stand where a command's words do not say it.
struct CompletedNames {
    std::vector<std::string> parameters;  ///< for NAME,NAME and PARAMETER
    std::vector<std::string> settings;    ///< for KEY=VALUE, parameters among them
};

/// A script that lets a shell complete commands, options, their choices, names of parameters and files.
[[nodiscard]] std::string bash_completion(const CommandWords& program, const CompletedNames& names);
[[nodiscard]] std::string zsh_completion(const CommandWords& program, const CompletedNames& names);
[[nodiscard]] std::string fish_completion(const CommandWords& program, const CompletedNames& names);

}  // namespace skinfit
