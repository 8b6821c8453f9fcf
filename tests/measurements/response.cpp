#include "measurements/response.hpp"
#include "tests/support/refusal.hpp"

#include <gtest/gtest.h>

namespace skinfit {
namespace {

TEST(Response, IsLinearBetweenItsPointsAndZeroOutside) {
    const Response response =
        parse_response("# a filter\nwavelength_nm,response\n400,0\n500,80\n600,20\n", "filter.csv");
    EXPECT_EQ(response(400), 0.0);
    EXPECT_EQ(response(450), 40.0);
    EXPECT_EQ(response(500), 80.0);
    EXPECT_EQ(response(550), 50.0);
    EXPECT_EQ(response(600), 20.0);
    EXPECT_EQ(response(399.9), 0.0);
    EXPECT_EQ(response(600.1), 0.0);
}

TEST(Response, OnePointIsOneWavelength) {
    const Response response = parse_response("550 2\n", "line");
    EXPECT_EQ(response(550), 2.0);
    EXPECT_EQ(response(551), 0.0);
}

TEST(Response, WhatIsNoResponseIsRefusedWithItsLine) {
    const auto message = [](const char* text) -> std::string {
        return test::refusal_of([&] { (void)parse_response(text, "f.csv"); });
    };
    EXPECT_EQ(
        message("500,1\n400,2\n"),
        "f.csv:2: 400 nm follows 500 nm (wavelengths must ascend); sort the lines and keep one for each wavelength");
    EXPECT_NE(message("500,1\n500,2\n"), "");
    EXPECT_EQ(message("400,1\n500,-2\n"),
              "f.csv:2: the response -2 is negative (it is the weight of a wavelength); correct it or set it to 0");
    EXPECT_NE(message("400,x\n"), "");
    EXPECT_NE(message(""), "");
}

}  // namespace
}  // namespace skinfit
