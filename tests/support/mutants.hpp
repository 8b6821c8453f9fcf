#pragma once

#include <random>
#include <string>
#include <string_view>

namespace skinfit::test {

/// `text` with one byte deleted, up to 30 doubled (so that lines repeat), or one replaced by any byte or by one of
/// `marks`, those of the grammar.
[[nodiscard]] std::string mutated(std::string text, std::string_view marks, std::mt19937_64& random);

}  // namespace skinfit::test
