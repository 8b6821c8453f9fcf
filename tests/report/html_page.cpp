#include "report/html_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "core/text.hpp"
#include "tests/report/tag_balance.hpp"

namespace skinfit {
namespace {

const HtmlPage example{.title = "A & <b>",
                       .summary = badge("suspect"),
                       .sections = {{.title = "Data & \xC3\xA4ll", .body = paragraph("one")},
                                    {.title = "Data: \xC3\xA4ll", .body = paragraph("two"), .starts_page = true},
                                    {.title = "\xC3\xA4", .body = {}}},
                       .footer = "the end"};

std::size_t count(std::string_view text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(Page, IsWellFormed) {
    EXPECT_EQ(test::tag_complaint(html_page(example)), "");
    EXPECT_EQ(test::tag_complaint(html_page("x", paragraph("y"))), "");
}

TEST(Page, IsAFunctionOfItsInput) {
    EXPECT_EQ(html_page(example), html_page(example));
}

TEST(Page, HasOneHeadingOfTheFirstLevelALanguageAndLandmarks) {
    const std::string page = html_page(example);
    for (const char* once : {"<h1>", "<html lang=\"en\">", "<header>", "<nav ", "<main>", "<footer>", "<title>"}) {
        EXPECT_EQ(count(page, once), 1U) << once;
    }
    EXPECT_NE(page.find("<h1>A &amp; &lt;b&gt;</h1>"), std::string::npos);
}

TEST(Page, AllowsNothingToBeLoadedOrRun) {
    const std::string page = html_page(example);
    EXPECT_EQ(count(page, "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:;"), 1U);
    for (const char* never : {"<script", "<link", "<iframe", "@import", "url(", "http:", "https:", " src="}) {
        EXPECT_EQ(count(page, never), 0U) << never;
    }
}

TEST(Page, EveryLinkOfTheContentsHasItsAnchor) {
    const std::vector<std::string> anchors = anchors_of(example.sections);
    EXPECT_EQ(anchors, (std::vector<std::string>{"data-ll", "data-ll-2", "section"}));
    const std::string page = html_page(example);
    for (const std::string& anchor : anchors) {
        EXPECT_EQ(count(page, "href=\"#" + anchor + "\""), 1U);
        EXPECT_EQ(count(page, "<h2 id=\"" + anchor + "\""), 1U);
    }
}

/// Relative luminance of "#rrggbb". [WCAG21]
double luminance(std::string_view hex) {
    constexpr std::array<double, 3> share = {0.2126, 0.7152, 0.0722};
    double sum = 0.0;
    for (std::size_t i = 0; i < share.size(); ++i) {
        int code = 0;
        std::from_chars(hex.data() + 1 + 2 * i, hex.data() + 3 + 2 * i, code, 16);
        const double encoded = code / 255.0;
        sum += share[i] * (encoded <= 0.03928 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return sum;
}

double contrast(std::string_view first, std::string_view second) {
    const auto [dark, light] = std::minmax({luminance(first), luminance(second)});
    return (light + 0.05) / (dark + 0.05);
}

/// The colours by name in light, in the dark and on paper: a block of the page's style that sets some of them leaves
/// the others as in light.
std::vector<std::map<std::string, std::string>> palettes(std::string_view page) {
    std::vector<std::map<std::string, std::string>> found;
    for (const std::string_view line : split_lines(page)) {
        if (trimmed(line) == ":root {") {
            found.push_back(found.empty() ? std::map<std::string, std::string>() : found.front());
        }
        const std::string_view text = trimmed(line);
        if (!text.starts_with("--")) continue;
        const std::size_t colon = text.find(':');
        found.back()[std::string(text.substr(2, colon - 2))] = text.substr(colon + 2, 7);
    }
    return found;
}

TEST(Page, TextCanBeReadOnEveryGround) {
    constexpr double least = 4.5;  // [WCAG21, 1.4.3]
    const auto found = palettes(html_page(example));
    ASSERT_EQ(found.size(), 3U);
    for (const auto& colours : found) {
        for (const char* ink : {"text", "muted", "link"}) {
            EXPECT_GE(contrast(colours.at(ink), colours.at("page")), least) << ink;
        }
        EXPECT_GE(contrast(colours.at("text"), colours.at("head")), least);
        for (const std::string badge : {"good", "doubtful", "bad", "neutral"}) {
            EXPECT_GE(contrast(colours.at(badge), colours.at(badge + "-page")), least) << badge;
        }
    }
}

TEST(Contrast, IsThatOfTheExtremes) {
    EXPECT_NEAR(contrast("#000000", "#ffffff"), 21.0, 1e-12);
    EXPECT_EQ(contrast("#777777", "#777777"), 1.0);
    EXPECT_LT(contrast("#777777", "#ffffff"), 4.5);  // the usual example of a grey just too light
}

}  // namespace
}  // namespace skinfit
