#include "model/trigonometry.hpp"

#include <gtest/gtest.h>

namespace skinfit {
namespace {

// The stated truncation error of the series; the roundings of Horner's rule are a million times smaller.
constexpr double stated_error = 2e-10;
constexpr int points = 100'000;

TEST(Trigonometry, SmallAnglesKeepTheStatedError) {
    for (int i = 0; i <= points; ++i) {
        const double angle = 1.2 * i / points;
        ASSERT_NEAR(small_cosine(angle), std::cos(angle), stated_error);
        ASSERT_NEAR(small_sine(angle), std::sin(angle), stated_error);
    }
}

TEST(Trigonometry, TurnsKeepTheStatedError) {
    for (int i = 0; i <= points; ++i) {
        const double turns = static_cast<double>(i) / points;
        ASSERT_NEAR(cosine_of_turns(turns), std::cos(2.0 * pi * turns), stated_error);
        ASSERT_NEAR(sine_of_turns(turns), std::sin(2.0 * pi * turns), stated_error);
    }
}

TEST(Trigonometry, ErrorIsTheFirstNeglectedTerm) {
    // Alternating series: at the end of the range the error is that term less a part of the next.
    const double last = std::pow(1.2, 14) / 87178291200.0;  // 14!
    const double next = last * 1.2 * 1.2 / (15 * 16);
    const double error = small_cosine(1.2) - std::cos(1.2);
    EXPECT_LE(error, last + 1e-15);
    EXPECT_GE(error, last - next - 1e-15);
}

}  // namespace
}  // namespace skinfit
