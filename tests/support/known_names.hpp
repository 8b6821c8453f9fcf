#pragma once

#include <set>
#include <string>

namespace skinfit::test {

using Names = std::set<std::string, std::less<>>;

/// Every name that a file or an output may carry: of parameters, settings and the values these take, the words of JSON
/// Schema, and the vocabulary.
[[nodiscard]] Names known_names();

}  // namespace skinfit::test
