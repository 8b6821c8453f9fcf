#include "model/colour.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/input_error.hpp"
#include "model/table.hpp"

namespace skinfit {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Two sums of 81 positive products and their ratio: fewer than 200 roundings, each of half an epsilon.
constexpr double sum_rounding = 100 * epsilon;

constexpr std::array every_viewing = {
    Viewing{Illuminant::d65, Observer::two_degrees}, Viewing{Illuminant::d65, Observer::ten_degrees},
    Viewing{Illuminant::equal_energy, Observer::two_degrees}, Viewing{Illuminant::equal_energy, Observer::ten_degrees}};

struct Grid {
    double first_nm, last_nm, step_nm;
};

ColourStimulus sampled(const Grid& grid, const std::function<double(double)>& spectrum) {
    ColourStimulus stimulus;
    const auto steps = static_cast<int>(std::lround((grid.last_nm - grid.first_nm) / grid.step_nm));
    for (int i = 0; i <= steps; ++i) {
        stimulus.wavelength_nm.push_back(grid.first_nm + i * grid.step_nm);
        stimulus.value.push_back(spectrum(stimulus.wavelength_nm.back()));
    }
    return stimulus;
}

constexpr Grid nodes{.first_nm = 380, .last_nm = 780, .step_nm = 5};

double wavy(double nm) {
    return 0.5 + 0.4 * std::sin(nm / 30.0);
}

std::array<double, 3> values(const Xyz& xyz) {
    return {xyz.x, xyz.y, xyz.z};
}

void expect_equal(const Xyz& a, const Xyz& b) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(values(a)[i], values(b)[i]) << i;
}

void expect_close(const Xyz& a, const Xyz& b, double relative) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(values(a)[i], values(b)[i], relative * values(b)[i]) << i;
}

/// The white by a sum that shares no code with the one under test.
Xyz white_by_sum(const Viewing& viewing, const Grid& grid) {
    const Table& observers = embedded_table("cie_observers");
    const std::size_t column = viewing.observer == Observer::two_degrees ? 1 : 4;
    std::array<double, 3> sum{};
    for (std::size_t row = 0; row < observers.columns[0].size(); ++row) {
        const double nm = observers.columns[0][row];
        if (nm < grid.first_nm || nm > grid.last_nm || std::fmod(nm - grid.first_nm, grid.step_nm) != 0.0) continue;
        const auto d65_row = static_cast<std::size_t>((nm - 300.0) / 5.0);
        const double power =
            viewing.illuminant == Illuminant::d65 ? embedded_table("cie_d65").columns[1][d65_row] : 1.0;
        for (std::size_t i = 0; i < 3; ++i) sum[i] += power * observers.columns[column + i][row];
    }
    return {100.0 * sum[0] / sum[1], 100.0, 100.0 * sum[2] / sum[1]};
}

TEST(Colour, PerfectDiffuserIsTheWhiteToTheLastBit) {
    for (const Viewing& viewing : every_viewing) {
        for (const Grid& grid : {nodes, Grid{400, 700, 10}, Grid{383.7, 771.1, 4.3}, Grid{300, 1000, 7}}) {
            const SeenColour seen = colour_of(sampled(grid, [](double) { return 1.0; }), viewing);
            expect_equal(seen.xyz, seen.white);
            expect_equal(seen.white, white(viewing));
            EXPECT_EQ(seen.white.y, 100.0);
        }
    }
}

TEST(Colour, WhiteIsTheSumOfTheTables) {
    for (const Viewing& viewing : every_viewing) {
        expect_close(white(viewing), white_by_sum(viewing, nodes), sum_rounding);
    }
}

TEST(Colour, WhiteOfD65IsThePublishedOne) {
    // [CIE15] prints two decimals of X and Z and five of x and y: right to half the last digit.
    const Xyz d65 = white({Illuminant::d65, Observer::two_degrees});
    EXPECT_NEAR(d65.x, 95.04, 0.005);
    EXPECT_NEAR(d65.z, 108.88, 0.005);
    EXPECT_NEAR(d65.x / (d65.x + d65.y + d65.z), 0.31272, 5e-6);
    EXPECT_NEAR(d65.y / (d65.x + d65.y + d65.z), 0.32903, 5e-6);
}

TEST(Colour, WhiteOfTheFinerSumIsWithinTheErrorOfTheSteps) {
    // Halving the step of such a sum takes away at least half of its error, so the step from 10 to 5 nm bounds the
    // rest; the tables tell what lies below 380 nm; the whites of ASTM E308 have three decimals.
    const auto expect_near_published = [](const Viewing& viewing, const Xyz& published) {
        const Xyz fine = white_by_sum(viewing, nodes);
        const Xyz coarse = white_by_sum(viewing, {380, 780, 10});
        const Xyz longer = white_by_sum(viewing, {360, 780, 5});
        const Xyz found = white(viewing);
        for (std::size_t i = 0; i < 3; ++i) {
            const double bound =
                std::abs(values(fine)[i] - values(coarse)[i]) + std::abs(values(fine)[i] - values(longer)[i]) + 0.0005;
            EXPECT_NEAR(values(found)[i], values(published)[i], bound) << i;
        }
    };
    expect_near_published({Illuminant::d65, Observer::two_degrees}, {95.047, 100.0, 108.883});
    expect_near_published({Illuminant::d65, Observer::ten_degrees}, {94.811, 100.0, 107.304});
}

TEST(Colour, OneWavelengthHasItsPlaceOnTheSpectrumLocus) {
    // Published chromaticities of the observer of 1931, five decimals; a line of 5 nm at a node is that wavelength
    // alone.
    struct Place {
        double nm, x, y;
    };
    for (const Place& place :
         {Place{460, 0.14396, 0.02970}, Place{520, 0.07430, 0.83380}, Place{700, 0.73469, 0.26531}}) {
        const ColourStimulus line = sampled(nodes, [&](double nm) { return nm == place.nm ? 1.0 : 0.0; });
        const Xyz xyz = colour_of(line, {}).xyz;
        EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), place.x, 5e-6);
        EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), place.y, 5e-6);
    }
}

TEST(Colour, IsLinearInTheSpectrum) {
    for (const Viewing& viewing : every_viewing) {
        const Xyz first = colour_of(sampled(nodes, wavy), viewing).xyz;
        const Xyz second = colour_of(sampled(nodes, [](double nm) { return nm / 1000.0; }), viewing).xyz;
        const Xyz both =
            colour_of(sampled(nodes, [](double nm) { return 0.25 * wavy(nm) + 0.75 * nm / 1000.0; }), viewing).xyz;
        expect_close(
            both,
            {0.25 * first.x + 0.75 * second.x, 0.25 * first.y + 0.75 * second.y, 0.25 * first.z + 0.75 * second.z},
            sum_rounding);
    }
}

TEST(Colour, SpectrumIsLinearBetweenItsWavelengths) {
    const auto tent = [](double nm) { return 1.0 - std::abs(nm - 580.0) / 400.0; };
    const Xyz fine = colour_of(sampled(nodes, tent), {}).xyz;
    expect_close(colour_of(sampled({380, 780, 20}, tent), {}).xyz, fine, sum_rounding);
    expect_close(colour_of({.wavelength_nm = {330, 580, 830}, .value = {tent(330), 1.0, tent(830)}}, {}).xyz, fine,
                 sum_rounding);
}

TEST(Colour, BeyondItsEndsTheSpectrumHoldsItsValue) {
    const ColourStimulus narrow = sampled({400, 700, 10}, wavy);
    ColourStimulus held = narrow;
    held.wavelength_nm.insert(held.wavelength_nm.begin(), 360.0);
    held.value.insert(held.value.begin(), wavy(400));
    held.wavelength_nm.push_back(830.0);
    held.value.push_back(wavy(700));
    for (const Viewing& viewing : every_viewing) {
        expect_equal(colour_of(narrow, viewing).xyz, colour_of(held, viewing).xyz);
    }
}

TEST(Colour, HeldShareIsTheShareOfWhiteBeyondTheEnds) {
    for (const Viewing& viewing : every_viewing) {
        expect_equal(colour_of(sampled(nodes, wavy), viewing).held_share, {0.0, 0.0, 0.0});
        const SeenColour outer =
            colour_of(sampled(nodes, [](double nm) { return nm < 400 || nm > 700 ? 1.0 : 0.0; }), viewing);
        const Xyz share = colour_of(sampled({400, 700, 10}, wavy), viewing).held_share;
        expect_close(share, {outer.xyz.x / outer.white.x, outer.xyz.y / outer.white.y, outer.xyz.z / outer.white.z},
                     sum_rounding);
    }
}

TEST(Colour, HeldSharesOfTheNarrowestSpectrumAreBelowTheStatedOnes) {
    for (const Viewing& viewing : every_viewing) {
        const Xyz share = colour_of(sampled({420, 680, 10}, wavy), viewing).held_share;
        EXPECT_LT(share.x, 0.017);
        EXPECT_LT(share.y, 0.003);
        EXPECT_LT(share.z, 0.06);
    }
}

TEST(Colour, WidestStepIsThatOfTheVisibleRange) {
    const auto widest = [](const std::vector<double>& nm) {
        return colour_of({.wavelength_nm = nm, .value = std::vector<double>(nm.size(), 0.5)}, {}).widest_step_nm;
    };
    EXPECT_EQ(widest({200, 380, 390, 420, 700, 780, 900}), 280.0);
    EXPECT_EQ(widest({400, 500, 550, 690}), 140.0);
    EXPECT_EQ(widest({200, 500, 780, 2000}), 300.0);
}

TEST(Colour, NarrowSpectraAreRefused) {
    const auto flat = [](double) { return 0.5; };
    EXPECT_NO_THROW((void)colour_of(sampled({420, 680, 20}, flat), {}));
    EXPECT_THROW((void)colour_of(sampled({421, 701, 20}, flat), {}), InputError);
    EXPECT_THROW((void)colour_of({.wavelength_nm = {550}, .value = {0.5}}, {}), InputError);
    try {
        (void)colour_of(sampled({400, 679, 9}, flat), {});
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "colour of a spectrum: it reaches from 400 to 679 nm (a colour needs at least 420 to 680 nm); "
                  "give a spectrum that reaches further, or ask for no colour");
    }
}

}  // namespace
}  // namespace skinfit
