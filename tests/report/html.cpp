#include "report/html.hpp"

#include <gtest/gtest.h>

#include "report/html_figure.hpp"
#include "report/html_table.hpp"
#include "tests/report/tag_balance.hpp"

namespace skinfit {
namespace {

using test::tag_complaint;

const std::string hostile = "</td><script>alert('1')</script>\" onload=\"x&amp;\x01\xff";
const std::string nothing;

TEST(Escaped, LeavesNoCharacterThatMeansSomethingInMarkup) {
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    const std::string markup = escaped(all + hostile).markup;
    EXPECT_EQ(markup.find_first_of("<>\"'"), std::string::npos);
    EXPECT_EQ(tag_complaint(markup), nothing);
}

TEST(Escaped, LeavesOtherTextAsItIs) {
    EXPECT_EQ(escaped("5 \xC2\xB5m, 95 % \xE2\x89\xA4 1;\n\ta=b").markup, "5 \xC2\xB5m, 95 % \xE2\x89\xA4 1;\n\ta=b");
    EXPECT_EQ(escaped("").markup, "");
}

TEST(Escaped, TellsAmpersandsOfTextFromReferences) {
    EXPECT_EQ(escaped("a&lt;").markup, "a&amp;lt;");
    EXPECT_EQ(escaped(escaped("<").markup).markup, "&amp;lt;");
}

TEST(Escaped, IsWhatTheTextWasForEveryPartOfIt) {
    EXPECT_EQ(escaped("a<b").markup + escaped("&c").markup, escaped("a<b&c").markup);
}

TEST(Escaped, ReplacesBytesThatAreNotUtf8AndControlCharacters) {
    EXPECT_EQ(escaped("a\xff").markup, "a\xEF\xBF\xBD");
    EXPECT_EQ(escaped("\xc0\xbc").markup.find('\xc0'), std::string::npos);  // an overlong `<`
    EXPECT_EQ(escaped("a\x1b\x7f").markup, "a\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(Element, EscapesTheValuesOfAttributes) {
    EXPECT_EQ(element("a", escaped("x"), {{"href", "#\"'<"}}).markup, "<a href=\"#&quot;&#39;&lt;\">x</a>");
}

TEST(Pieces, AreWellFormedWithHostileText) {
    const HtmlTable table{.caption = hostile,
                          .columns = {{.name = hostile, .cells = Cells::text}, {.name = "b", .unit = hostile}},
                          .rows = {{escaped(hostile), badge(hostile)}}};
    const HtmlFigure figure{.picture = "<svg></svg>", .alternative = hostile, .caption = hostile};
    const Html all = paragraph(hostile) + subheading(hostile) + bullet_list({escaped(hostile)}) +
                     definition_list({{hostile, escaped(hostile)}}) + folded_text(hostile, hostile) +
                     swatch("#a0b1c2", hostile) + html_table(table) + html_figure(figure);
    EXPECT_EQ(tag_complaint(all.markup), nothing);
    EXPECT_EQ(all.markup.find("<script"), std::string::npos);
    EXPECT_EQ(all.markup.find("onload=\""), std::string::npos);
}

TEST(TagBalance, FindsWhatIsWrong) {
    for (const char* markup : {"<p>", "</p>", "<p><b></p></b>", "a & b", "<p", "a > b", "<a href=\"x>y</a>"}) {
        EXPECT_NE(tag_complaint(markup), nothing) << markup;
    }
    EXPECT_EQ(tag_complaint("<p class=\"a b\">x &lt; &#39;<br /></p>"), nothing);
}

TEST(Badge, SaysGoodOfAnAnswerAndBadOfNone) {
    const auto is_said = [](std::string_view word, std::string_view meaning) {
        return badge(word).markup ==
               "<span class=\"badge " + std::string(meaning) + "\">" + std::string(word) + "</span>";
    };
    EXPECT_TRUE(is_said("consistent", "good"));
    EXPECT_TRUE(is_said("fitted", "good"));
    EXPECT_TRUE(is_said("suspect", "doubtful"));
    EXPECT_TRUE(is_said("failed", "bad"));
    EXPECT_TRUE(is_said("rejected", "bad"));
    EXPECT_TRUE(is_said("pending", "neutral"));
}

TEST(Table, HeadsEveryRowAndColumnAndKeepsTheUnit) {
    const HtmlTable table{.caption = "fit",
                          .columns = {{.name = "parameter", .cells = Cells::text}, {.name = "value", .unit = "g/L"}},
                          .rows = {{escaped("bilirubin"), escaped("0.5")}}};
    const std::string markup = html_table(table).markup;
    EXPECT_NE(markup.find("<caption>fit</caption>"), std::string::npos);
    EXPECT_NE(markup.find("<th scope=\"col\">parameter</th>"), std::string::npos);
    EXPECT_NE(markup.find("<th scope=\"col\" class=\"number\">value <span class=\"unit\">(g/L)</span></th>"),
              std::string::npos);
    EXPECT_NE(markup.find("<th scope=\"row\">bilirubin</th><td class=\"number\">0.5</td>"), std::string::npos);
}

TEST(Base64, GivesTheExamplesOfTheStandard) {  // [RFC4648, Sec. 10]
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Figure, KnowsPicturesByTheirBytes) {
    const auto starts = [](const std::string& picture, std::string_view address) {
        const HtmlFigure figure{.picture = picture, .alternative = "a", .caption = ""};
        return html_figure(figure).markup.find("<img src=\"" + std::string(address)) != std::string::npos;
    };
    EXPECT_TRUE(starts("\x89PNG\r\n\x1a\n...", "data:image/png;base64,iVBORw0KGgo"));
    EXPECT_TRUE(starts("<?xml version=\"1.0\"?><svg></svg>", "data:image/svg+xml;base64,PD94"));
}

}  // namespace
}  // namespace skinfit
