#include "core/csv.hpp"

#include <gtest/gtest.h>

namespace skinfit {
namespace {

TEST(CsvCell, QuotesWhatNeedsIt) {
    EXPECT_EQ(csv_cell("plain words"), "plain words");
    EXPECT_EQ(csv_cell(""), "");
    EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_cell("a;b"), "\"a;b\"");
    EXPECT_EQ(csv_cell("say \"a\""), "\"say \"\"a\"\"\"");
    EXPECT_EQ(csv_cell("M\xc3\xbcller"), "M\xc3\xbcller");
}

TEST(CsvCell, IsOnOneLine) {
    EXPECT_EQ(csv_cell("two\r\nlines\tand\x1b"), "two\\r\\nlines\\tand\\x1b");
}

TEST(CsvCell, IsNoFormula) {
    EXPECT_EQ(csv_cell("=1+1"), "'=1+1");
    EXPECT_EQ(csv_cell("+cmd|' /C calc'!A0"), "'+cmd|' /C calc'!A0");
    EXPECT_EQ(csv_cell("-2+3,4"), "\"'-2+3,4\"");
    EXPECT_EQ(csv_cell("@SUM(A1)"), "'@SUM(A1)");
    EXPECT_EQ(csv_cell("-12.5"), "-12.5") << "a number";
    EXPECT_EQ(csv_cell("-"), "-") << "a dash alone is calculated by none";
}

TEST(MarkedAsText, ComesBack) {
    for (const std::string_view text : {"=1+1", "+a", "-b", "@c", "-1", "arm", "'quoted'", "'", ""}) {
        EXPECT_EQ(without_text_mark(marked_as_text(text)), text);
    }
}

}  // namespace
}  // namespace skinfit
