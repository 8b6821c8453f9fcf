#pragma once

#include <string>
#include <string_view>

namespace skinfit::house {

/// The lines of a document, with empty ones for its code blocks and their fences.
[[nodiscard]] std::string without_code_blocks(std::string_view document);

/// The same with blanks for code within lines too.
[[nodiscard]] std::string without_code(std::string_view document);

}  // namespace skinfit::house
