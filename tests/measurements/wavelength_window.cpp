#include "measurements/wavelength_window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "measurements/quality.hpp"
#include "measurements/text_reader.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

using Numbers = std::vector<double>;

const WavelengthWindow visible{.range = {.lowest_nm = 400, .highest_nm = 700}, .excluded = {{500, 510}}};

std::string refusal(const std::string& text, const WavelengthWindow& window = visible) {
    return test::refusal_of([&] { (void)parse_spectrum(text, "a.csv", {.window = window}); });
}

TEST(WavelengthWindows, HoldTheirEndsAndNotWhatIsExcluded) {
    for (const double nm : {400.0, 499.9, 510.1, 700.0}) EXPECT_TRUE(visible.contains(nm)) << nm;
    for (const double nm : {399.9, 500.0, 505.0, 510.0, 700.1}) EXPECT_FALSE(visible.contains(nm)) << nm;
    EXPECT_TRUE(WavelengthWindow{}.contains(1e4));
}

TEST(WavelengthWindows, TakeEverythingOfASpectrumThatLiesInThem) {
    Spectrum spectrum;
    spectrum.wavelength_nm = {390, 400, 505, 600, 600, 800, 800};
    spectrum.value = {0, 1, 2, 3, 4, 5, 6};
    spectrum.sigma = {10, 11, 12, 13, 14, 15, 16};
    spectrum.repeats = {{20, 21, 22, 23, 24, 25, 26}};
    spectrum.missing_nm = {395, 405, 507};
    spectrum.repeated = {{.wavelength_nm = 600, .where = "a", .first = "b"},
                         {.wavelength_nm = 800, .where = "c", .first = "d"}};
    const Spectrum part = part_of(spectrum, visible);
    EXPECT_EQ(part.wavelength_nm, (Numbers{400, 600, 600}));
    EXPECT_EQ(part.value, (Numbers{1, 3, 4}));
    EXPECT_EQ(part.sigma, (Numbers{11, 13, 14}));
    EXPECT_EQ(part.repeats.front(), (Numbers{21, 23, 24}));
    EXPECT_EQ(part.missing_nm, Numbers{405});
    ASSERT_EQ(part.repeated.size(), 1U);
    EXPECT_EQ(part.repeated.front().where, "a");
}

TEST(WavelengthWindows, AreAllThatDecidesAUnit) {
    const std::string fractions = "200,900\n210,-900\n220,900\n800,900\n900,900\n450,0.2\n550,0.3\n";
    EXPECT_EQ(part_of(parse_spectrum(fractions, "a", {.window = visible}), visible).value, (Numbers{0.2, 0.3}));
    const std::string percent = "200,0\n210,0.1\n220,1\n800,1\n900,1\n450,20\n550,30\n";
    EXPECT_EQ(part_of(parse_spectrum(percent, "a", {.window = visible}), visible).value, (Numbers{0.2, 0.3}));
    // Where they hold nothing, all of it counts.
    EXPECT_EQ(parse_spectrum("800,20\n900,30\n", "a", {.window = visible}).value, (Numbers{0.2, 0.3}));
}

TEST(WavelengthWindows, AreAllThatIsRefused) {
    for (const std::string outside : {"390,-1,1", "390,2,0", "505,2,-1", "705,0.5,", "300,0.5,1\n300,0.6,1"}) {
        const std::string text = "nm,R,sigma\n450,0.2,0.01\n550,0.3,0.01\n" + outside + "\n";
        EXPECT_EQ(refusal(text), "") << outside;
        EXPECT_NE(refusal(text, {}), "") << outside;
    }
    EXPECT_EQ(refusal("450,0.2\n650,0.3\n390,0.1\n450,0.25\n390,0.2\n"),
              "a.csv:4: repeats the wavelength 450 nm (line 1 has it already); keep one of the two or average them");
}

TEST(WavelengthWindows, MakeTheScatterOfRepeatsTheirOwn) {
    std::string table = "Made up,,,\nReflectance factor,,,\n,Subject 7,,\nWavelength (nm),R1,R2,Average\n";
    std::string noisy = table;
    for (int nm = 350; nm <= 700; nm += 10) {
        const std::string row = std::to_string(nm) + ",0.30,0.32,0.31\n";
        table += row;
        noisy += nm < 400 ? std::to_string(nm) + ",-90,90,\n" : row;
    }
    const auto sigma = [](const std::string& text) {
        const ReadOptions options{.column = "subject 7 mean",
                                  .window = {.range = {.lowest_nm = 400, .highest_nm = 700}}};
        return part_of(parse_spectrum(text, "a", options), options.window).sigma;
    };
    ASSERT_EQ(sigma(table).size(), 31U);
    EXPECT_EQ(sigma(noisy), sigma(table));
    // Two readings 0.02 apart: their mean is known to 0.01, rounding aside.
    EXPECT_NEAR(sigma(table).front(), 0.01, 1e-5);
}

}  // namespace
}  // namespace skinfit
