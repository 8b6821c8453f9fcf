#pragma once

#include <string>
#include <vector>

#include "report/html.hpp"

namespace skinfit {

/// A part of a page with a heading of its own.
struct HtmlSection {
    std::string title;
    Html body;
    bool starts_page = false;  ///< on paper
};

/// A page that needs nothing but itself: no network, no script.
struct HtmlPage {
    std::string title;
    Html summary;  ///< below the title, before the table of contents
    std::vector<HtmlSection> sections;
    std::string footer{};
};

/// The file: style, title, summary, table of contents (of two sections or more), sections with anchors made of their
/// titles, footer.
[[nodiscard]] std::string html_page(const HtmlPage& page);

/// The same without sections, with `body` below the title.
[[nodiscard]] std::string html_page(const std::string& title, const Html& body);

/// The anchors of `sections`: the letters and digits of each title in lower case, joined by hyphens; numbered where
/// that would be given twice.
[[nodiscard]] std::vector<std::string> anchors_of(const std::vector<HtmlSection>& sections);

}  // namespace skinfit
