#include "core/utf8.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

TEST(IsUtf8, TakesTheWellFormedSequencesOfRfc3629Alone) {
    EXPECT_TRUE(is_utf8(""));
    EXPECT_TRUE(is_utf8("arm, \xc3\xa9, \xe2\x82\xac, \xf0\x9f\x98\x80, \xf4\x8f\xbf\xbf"));
    EXPECT_FALSE(is_utf8("\xe9t\xe9"));         // Latin-1
    EXPECT_FALSE(is_utf8("\xc0\xaf"));          // a slash, overlong
    EXPECT_FALSE(is_utf8("\xe0\x80\xaf"));      // the same
    EXPECT_FALSE(is_utf8("\xed\xa0\x80"));      // a surrogate
    EXPECT_FALSE(is_utf8("\xf4\x90\x80\x80"));  // beyond U+10FFFF
    EXPECT_FALSE(is_utf8("\xe2\x82"));          // cut off
    EXPECT_FALSE(is_utf8("\x80"));              // a continuation alone
}

TEST(Printable, LeavesReadableTextAsItIs) {
    const std::string text = "forearm 3 (left), M\xc3\xbcller, \xe7\x9a\xae\xe8\x86\x9a \xf0\x9f\x98\x80 \\x1b";
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
    EXPECT_EQ(printable("\x1b[2J\x07"), "\\x1b[2J\\x07");
    EXPECT_EQ(printable("arm\nverdict: consistent\r\n\t."), "arm\\nverdict: consistent\\r\\n\\t.");
    EXPECT_EQ(printable("\x7f \xc2\x9b"
                        "31m"),
              "\\x7f \\u009b31m");  // DEL, and CSI in one character
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xe2\x80\xae"
                        "gpj.exe"),
              "\\u202egpj.exe");                          // from right to left
    EXPECT_EQ(printable("a\xe2\x80\xa8z"), "a\\u2028z");  // a line end of Unicode
    EXPECT_EQ(printable("a\xef\xbb\xbfz"), "a\\ufeffz");
    EXPECT_EQ(printable("\xe9t\xe9"), "\\xe9t\\xe9");
}

TEST(Printable, ChangesNothingTheSecondTime) {
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    const std::string once = printable(all);
    EXPECT_TRUE(is_utf8(once));
    EXPECT_EQ(printable(once), once);
}

TEST(InputErrors, AreOneLineWhateverTheyQuote) {
    const InputError error({.where = "a\nerror: b", .problem = "\x1b[1mX", .why = "\xff", .remedy = "none\t"});
    EXPECT_STREQ(error.what(), "a\\nerror: b: \\x1b[1mX (\\xff); none\\t");
}

}  // namespace
}  // namespace skinfit
