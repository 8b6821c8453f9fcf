#pragma once

#include <string>
#include <string_view>

namespace skinfit {

/// A secret that nobody guesses: 128 bits of the system's random numbers as 32 hexadecimal digits. Throws
/// std::system_error where the system has none.
[[nodiscard]] std::string random_token();

/// Whether both texts are the same, in a time that depends on their lengths alone.
[[nodiscard]] bool same_secret(std::string_view given, std::string_view secret);

}  // namespace skinfit
