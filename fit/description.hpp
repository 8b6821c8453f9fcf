#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skinfit {

/// What a name of the program's files and outputs stands for, in lines of text: a parameter with its unit, limits,
/// bounds and source, a setting with the values it takes, a word of the outputs, a label of the reports, or the names
/// that an everyday word means. `asked` may have capitals. Nothing where there is none such.
[[nodiscard]] std::optional<std::string> description_of(std::string_view asked);

/// The same. Throws InputError with the nearest name where there is none such.
[[nodiscard]] std::string description(std::string_view asked);

/// The names of all parameters and settings with their meanings, a line each.
[[nodiscard]] std::string descriptions();

}  // namespace skinfit
