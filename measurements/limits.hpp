#pragma once

#include <cstddef>

/// What a file of spectra may have at most. Beyond these it is refused rather than read for hours or into all memory;
/// `largest_file_bytes` limits the file, and `parsed_json` how deep JSON nests.
namespace skinfit {

inline constexpr std::size_t longest_line_bytes = std::size_t{1} << 26U;  ///< 64 MiB
inline constexpr std::size_t most_columns = 1'000'000;
inline constexpr std::size_t most_jcamp_points = 10'000'000;              ///< of all spectra; they may be compressed
inline constexpr std::size_t largest_json_bytes = std::size_t{1} << 28U;  ///< 256 MiB; in memory it grows tenfold

}  // namespace skinfit
