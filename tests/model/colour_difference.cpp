#include "model/colour_difference.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace skinfit {
namespace {

struct Pair {
    Lab first, second;
    double difference;
};

/// [SHARMA05, Table 1]
constexpr std::array<Pair, 34> published = {{
    {{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
    {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
    {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
    {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
    {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
    {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
    {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
    {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
    {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
}};

std::vector<Lab> many_colours() {
    std::vector<Lab> colours;
    for (const double l : {0.0, 30.0, 50.0, 81.0, 100.0}) {
        for (const double a : {-70.0, -3.0, 0.0, 11.0, 64.0}) {
            for (const double b : {-90.0, -2.0, 0.0, 17.0, 80.0}) colours.push_back({.l = l, .a = a, .b = b});
        }
    }
    return colours;
}

TEST(Ciede2000, IsThePublishedDifferenceOfEveryPair) {
    for (const Pair& pair : published) {
        // Four decimals are printed.
        EXPECT_NEAR(ciede2000(pair.first, pair.second), pair.difference, 5e-5)
            << pair.first.a << ' ' << pair.first.b << ' ' << pair.second.a << ' ' << pair.second.b;
    }
}

TEST(Ciede2000, IsSymmetricToTheLastBit) {
    for (const Lab& first : many_colours()) {
        for (const Lab& second : many_colours()) ASSERT_EQ(ciede2000(first, second), ciede2000(second, first));
    }
    for (const Pair& pair : published) {
        EXPECT_EQ(ciede2000(pair.first, pair.second), ciede2000(pair.second, pair.first));
    }
}

TEST(Ciede2000, IsZeroForTheSameColourAndNoOther) {
    const std::vector<Lab> colours = many_colours();
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t j = 0; j < colours.size(); ++j) {
            if (i == j) {
                ASSERT_EQ(ciede2000(colours[i], colours[j]), 0.0);
            } else {
                ASSERT_GT(ciede2000(colours[i], colours[j]), 0.0);
            }
        }
    }
}

TEST(Ciede2000, OfGreysIsTheWeightedLightness) {
    // S_L = 1 + 0.015 d^2 / sqrt(20 + d^2) with d = 50 less than the mean lightness: d = 0, then 4, whose root is 6.
    // Relative roundings: fewer than ten.
    const auto greys = [](double first, double second) {
        return ciede2000({.l = first, .a = 0, .b = 0}, {.l = second, .a = 0, .b = 0});
    };
    constexpr double rounding = 10 * std::numeric_limits<double>::epsilon();
    EXPECT_EQ(greys(0, 100), 100.0);
    EXPECT_EQ(greys(45, 55), 10.0);
    EXPECT_NEAR(greys(50, 58), 8.0 / 1.04, 8 * rounding);
    EXPECT_NEAR(greys(42, 50), 8.0 / 1.04, 8 * rounding);
}

}  // namespace
}  // namespace skinfit
