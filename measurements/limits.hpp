#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// What a file of spectra may have at most. Beyond these it is refused rather than read for hours or into all memory;
/// `largest_file_bytes` limits the file, and `parsed_json` how deep JSON nests.
namespace skinfit {

inline constexpr std::size_t longest_line_bytes = std::size_t{1} << 24U;  ///< 16 MiB
inline constexpr std::size_t most_columns = 1'000'000;
inline constexpr std::size_t most_jcamp_points = 10'000'000;  ///< of all spectra of a file; they may be compressed
/// 128 MiB, of JSON, JCAMP-DX and CGATS: in memory their parts take up to twelve times as much.
inline constexpr std::size_t largest_structured_bytes = std::size_t{1} << 27U;

/// Throws InputError where line `number` of `source` has more `bytes` than that.
void refuse_long_line(std::size_t bytes, std::size_t number, const std::string& source);

/// Throws InputError where the text, of one of the three forms above, is larger than that.
void refuse_large_text(std::string_view text, const std::string& source);

}  // namespace skinfit
