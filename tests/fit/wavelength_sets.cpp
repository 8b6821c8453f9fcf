#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "fit/wavelength_sets.hpp"

namespace skinfit::test {
namespace {

std::vector<double> parsed(std::string_view text) {
    return parse_wavelengths(text, "here");
}

TEST(Wavelengths, GridIncludesItsLast) {
    EXPECT_EQ(parsed("400:700:100"), (std::vector<double>{400, 500, 600, 700}));
    EXPECT_EQ(parsed("400:450:20"), (std::vector<double>{400, 420, 440}));
    EXPECT_EQ(parsed("400:400:1"), (std::vector<double>{400}));
    EXPECT_EQ(parsed(" 400 : 410 : 5 "), (std::vector<double>{400, 405, 410}));
}

TEST(Wavelengths, FineGridIncludesItsLastExactly) {
    for (const auto& [text, count] : {std::pair{"400:700:0.1", 3001U}, std::pair{"400:700:0.3", 1001U},
                                      std::pair{"400:700:0.7", 429U}, std::pair{"380:730:0.05", 7001U}}) {
        const std::vector<double> grid = parsed(text);
        ASSERT_EQ(grid.size(), count) << text;
        EXPECT_EQ(grid.front(), text[0] == '4' ? 400 : 380);
        // Not beyond the last, where the tables may end, whatever the rounding.
        EXPECT_LE(grid.back(), text[0] == '4' ? 700 : 730) << text;
    }
    EXPECT_EQ(parsed("400:700:0.1").back(), 700);
}

TEST(Wavelengths, ListsAndSingleNumbers) {
    EXPECT_EQ(parsed("450, 540,660.5"), (std::vector<double>{450, 540, 660.5}));
    EXPECT_EQ(parsed("550"), (std::vector<double>{550}));
    EXPECT_EQ(parsed("5.5e2"), (std::vector<double>{550}));
}

TEST(Wavelengths, WhatIsNoSetIsRefused) {
    for (const std::string text :
         {"", "blue", "400,", "400:700", "400:700:", "400:700:20:1", "400:700:0", "400:700:-20", "700:400:20",
          "500,400", "400,400", "nan", "400:inf:1", "400;500", "400 500"}) {
        try {
            (void)parsed(text);
            FAIL() << text;
        } catch (const InputError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("here: \"" + text + "\"")) << error.what();
        }
    }
}

TEST(Wavelengths, MoreThanAreComputedAtATimeAreRefused) {
    std::string list = "300";
    for (int i = 1; i <= 10'000; ++i) list += "," + std::to_string(300 + i);
    for (const std::string& text : {std::string("400:700:1e-9"), std::string("400:700:0.003"), list}) {
        try {
            (void)parsed(text);
            FAIL() << text.substr(0, 20);
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("at most 10000"), std::string::npos) << error.what();
        }
    }
    EXPECT_EQ(parsed("400:499.99:0.01").size(), 10'000U);
}

}  // namespace
}  // namespace skinfit::test
