#pragma once

#include <string>

#include "app/command_tree.hpp"

namespace skinfit {

/// The manual page of the program, section 1, for `man`.
[[nodiscard]] std::string manual_page(const CommandWords& program);

}  // namespace skinfit
