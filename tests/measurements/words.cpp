#include "measurements/words.hpp"

#include <gtest/gtest.h>

namespace skinfit {
namespace {

TEST(InQuotes, IsOneShortLine) {
    EXPECT_EQ(in_quotes("a\tb\vc\nd"), "\"a b c d\"");
    EXPECT_EQ(in_quotes(std::string(40, 'x')), "\"" + std::string(40, 'x') + "\"");
    EXPECT_EQ(in_quotes(std::string(41, 'x')), "\"" + std::string(40, 'x') + "...\"");
}

TEST(InQuotes, CutsNoCharacterOfUtf8InTwo) {
    EXPECT_EQ(in_quotes(std::string(39, 'x') + "\u00b5m"), "\"" + std::string(39, 'x') + "...\"");
    EXPECT_EQ(in_quotes(std::string(38, 'x') + "\u00b5m"), "\"" + std::string(38, 'x') + "\u00b5...\"");
}

TEST(IsMissing, HoldsForNothingAndForTheUsualMarks) {
    for (const std::string_view cell : {"", "NaN", "nan", "NA", "n/a", "-", "inf", "#N/A", "1.#QNAN", "-1.#IND00"})
        EXPECT_TRUE(is_missing(cell)) << cell;
    for (const std::string_view cell : {"0", "-1", "nano", "info", "#1", "1.#"}) EXPECT_FALSE(is_missing(cell)) << cell;
}

TEST(StartsLikeANumber, HoldsForNumbersAndSlipsInThem) {
    for (const std::string_view cell : {"400", "4OO", "-0.5", "+.5", "0,5", ",5", "400 nm", "nan"}) {
        EXPECT_TRUE(starts_like_a_number(cell)) << cell;
    }
    for (const std::string_view cell : {"", "-", "nm", "R1", "nano", "O.5"}) {
        EXPECT_FALSE(starts_like_a_number(cell)) << cell;
    }
}

}  // namespace
}  // namespace skinfit
