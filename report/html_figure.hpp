#pragma once

#include <string>
#include <string_view>

#include "report/html.hpp"

namespace skinfit {

/// Base64 with padding. [RFC4648]
[[nodiscard]] std::string base64(std::string_view bytes);

/// A picture and what is said of it.
struct HtmlFigure {
    std::string picture;      ///< the bytes of an SVG or PNG file
    std::string alternative;  ///< what it shows, for those who do not see it
    std::string caption;      ///< below it; none where it is empty
};

/// The figure with its picture inside the page, on a white card. Asserts that the picture is SVG or PNG.
[[nodiscard]] Html html_figure(const HtmlFigure& figure);

}  // namespace skinfit
