#include "core/text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace skinfit {
namespace {

using Views = std::vector<std::string_view>;

TEST(Trimmed, RemovesWhiteSpaceAtBothEndsOnly) {
    EXPECT_EQ(trimmed(" \t\r\n\v\fa b\f\v\n\r\t "), "a b");
    EXPECT_EQ(trimmed("a"), "a");
    EXPECT_EQ(trimmed(" \t"), "");
    EXPECT_EQ(trimmed(""), "");
}

TEST(SplitLines, GivesTheSameLinesForEveryLineEnd) {
    const Views expected{"a", "", "b"};
    EXPECT_EQ(split_lines("a\n\nb\n"), expected);
    EXPECT_EQ(split_lines("a\r\n\r\nb\r\n"), expected);
    EXPECT_EQ(split_lines("a\r\rb\r"), expected);
    EXPECT_EQ(split_lines("a\r\n\rb"), expected);
}

TEST(SplitLines, NeedsNoLineEndAtTheEnd) {
    EXPECT_EQ(split_lines("a"), Views{"a"});
    EXPECT_EQ(split_lines("\n"), Views{""});
    EXPECT_TRUE(split_lines("").empty());
}

TEST(Split, GivesOneFieldMoreThanSeparators) {
    EXPECT_EQ(split("", ','), Views{""});
    EXPECT_EQ(split(" a ,b\t,, ", ','), (Views{"a", "b", "", ""}));
    EXPECT_EQ(split("a b", ','), Views{"a b"});
}

TEST(ParseNumber, ReadsCNotationAndALeadingPlus) {
    EXPECT_EQ(parse_number("4.5000000e+002"), 450.0);
    EXPECT_EQ(parse_number("+0.5"), 0.5);
    EXPECT_EQ(parse_number("-.5E1"), -5.0);
    EXPECT_EQ(parse_number("1."), 1.0);
    EXPECT_TRUE(std::isnan(parse_number("NaN").value()));
    EXPECT_TRUE(std::isinf(parse_number("-inf").value()));
}

TEST(ParseNumber, RefusesWhatIsNotOneNumber) {
    for (const std::string_view text :
         {"", "+", "-", "+-1", "++1", "-+1", "0x10", "1 2", " 1", "1 ", "1,5", "1e", "1e999", "one", "1d0"}) {
        EXPECT_EQ(parse_number(text), std::nullopt) << text;
    }
}

TEST(ParseNumber, ReadsNoFurtherThanItsView) {
    EXPECT_EQ(parse_number(std::string_view("123", 2)), 12.0);
}

TEST(ParseCount, ReadsIntegersUpToTheLargestThatADoubleHoldsExactly) {
    EXPECT_EQ(parse_count("2e6"), 2000000U);
    EXPECT_EQ(parse_count("0"), 0U);
    EXPECT_EQ(parse_count("9007199254740992"), 9007199254740992U);  // 2^53
    for (const std::string_view text : {"9007199254740994", "1.5", "-1", "nan", "inf", "", "x"}) {
        EXPECT_EQ(parse_count(text), std::nullopt) << text;
    }
}

TEST(NearestName, HasTheLeastEditDistance) {
    constexpr std::array<std::string_view, 3> names{"reflectance", "transmittance", "sigma"};
    EXPECT_EQ(nearest_name("reflectence", names), "reflectance");
    EXPECT_EQ(nearest_name("sgima", names), "sigma");
    EXPECT_EQ(nearest_name("transmittance", names), "transmittance");
    EXPECT_EQ(nearest_name("", names), "sigma");  // its distance is the length of the name
}

}  // namespace
}  // namespace skinfit
