#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// The largest number of wavelengths that are computed at a time; chosen: steps of 0.06 nm over all tables.
inline constexpr std::size_t most_wavelengths = 10'000;

/// Reads "400:700:20" (first:last:step), a list "400,450,500" or a single number, nm. Throws InputError naming `where`.
[[nodiscard]] std::vector<double> parse_wavelengths(std::string_view text, const std::string& where);

}  // namespace skinfit
