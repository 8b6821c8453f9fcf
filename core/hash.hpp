#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace skinfit {

/// The 128 bits of XXH3 of `bytes` as 32 hexadecimal digits: tells whether something has changed, not whether somebody
/// meant to deceive.
[[nodiscard]] std::string content_hash(std::string_view bytes);

}  // namespace skinfit
