#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skinfit {

/// Some lines and samples of a picture, counted from 0 at its first line and sample.
struct Rectangle {
    std::size_t first_sample;
    std::size_t first_line;
    std::size_t samples;  ///< above 0
    std::size_t lines;    ///< above 0
};

/// Reads `x,y,width,height`; `where` names the text in messages. Throws InputError for anything else.
[[nodiscard]] Rectangle parse_rectangle(std::string_view text, const std::string& where);

/// Which pixels of a cube to use: those in the rectangle and of the mask; all where neither is given.
struct RegionChoice {
    std::optional<std::filesystem::path> mask{};  ///< ENVI with one band, GeoTIFF or PNG, whose first band counts
    std::optional<Rectangle> rectangle{};
};

}  // namespace skinfit
