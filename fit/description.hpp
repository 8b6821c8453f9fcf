#pragma once

#include <string>
#include <string_view>

namespace skinfit {

/// What a name of the program's files and outputs stands for, in lines of text: a parameter with its unit, limits,
/// bounds and source, a setting with the values it takes, or a word of the outputs. `asked` may have capitals. Throws
/// InputError with the nearest name where there is none such.
[[nodiscard]] std::string description(std::string_view asked);

/// The names of all parameters and settings with their meanings, a line each.
[[nodiscard]] std::string descriptions();

}  // namespace skinfit
