#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// Reads "400:700:20" (first:last:step), a list "400,450,500" or a single number, nm. Throws InputError naming `where`.
[[nodiscard]] std::vector<double> parse_wavelengths(std::string_view text, const std::string& where);

}  // namespace skinfit
