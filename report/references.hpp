#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skinfit {

/// The references that `text` cites in brackets, by key, in the order of the project's list of references: the key, and
/// the reference as the list has it.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> cited_references(std::string_view text);

}  // namespace skinfit
