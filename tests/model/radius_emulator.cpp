#include "model/radius_emulator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/input_error.hpp"
#include "model/angular_solver.hpp"
#include "model/constants.hpp"
#include "model/spectrophotometer.hpp"
#include "tests/model/physiological_box.hpp"

namespace skinfit::test {
namespace {

const std::vector<double> wavelengths_nm = {405, 545, 577, 700};

EmulatorDomain domain_of(double incidence_deg, Side side, double lower_nm, double upper_nm) {
    EmulatorDomain domain{.sample = {},
                          .incidence_rad = incidence_deg * rad_per_deg,
                          .side = side,
                          .wavelengths_nm = wavelengths_nm,
                          .ranges = physiological_box};
    domain.ranges.push_back({Parameter::fibril_radius_nm, lower_nm, upper_nm});
    return domain;
}

RadiusEmulator made(const EmulatorDomain& domain) {
    return {domain, [](const EmulatorDomain& of_one) { return Emulator::build(of_one); }};
}

std::vector<RadiusShare> shares_of(const RadiusEmulator& emulator, const Skin& skin) {
    return emulator.respond(optical_depths(skin, extinctions(wavelengths_nm, Edition::revised)), skin.fibril_radius_nm);
}

double solved(const AngularSolver& solver, double wavelength_nm, Side side) {
    const AngularResponse response = solver.shares(wavelength_nm);
    return (side == Side::top ? response.reflected : response.transmitted).share;
}

TEST(RadiusEmulator, StaysWithinItsCertifiedErrorOfTheSolver) {
    for (const Side side : {Side::top, Side::bottom}) {
        const EmulatorDomain domain = domain_of(side == Side::top ? 8 : 45, side, 14, 42);
        const RadiusEmulator emulator = made(domain);
        const AngularSolver solver(domain.sample, {.incidence_rad = domain.incidence_rad});
        EXPECT_EQ(emulator.surface_share(), solver.shares(500).surface.share);
        double largest = 0.0;
        for (int number = 1; number <= 40; ++number) {
            const Skin skin = specimen(domain, number);
            const std::vector<RadiusShare> shares = shares_of(emulator, skin);
            for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
                const double off = std::abs(shares[i].share - solved(solver.with(skin), wavelengths_nm[i], side));
                EXPECT_LE(off, emulator.certified_error(i));
                largest = std::max(largest, off);
            }
        }
        constexpr double promised = 2e-4;
        EXPECT_LE(largest, promised);
        EXPECT_LE(emulator.certified_error(), 1e-3);
    }
}

TEST(RadiusEmulator, DerivativesAreThoseOfItsShares) {
    const EmulatorDomain domain = domain_of(8, Side::top, 14, 42);
    const RadiusEmulator emulator = made(domain);
    const Skin skin = specimen(domain, 6);
    const std::vector<RadiusShare> shares = shares_of(emulator, skin);
    constexpr double step_nm = 1e-3;
    Skin less = skin;
    Skin more = skin;
    less.fibril_radius_nm -= step_nm;
    more.fibril_radius_nm += step_nm;
    const std::vector<RadiusShare> below = shares_of(emulator, less);
    const std::vector<RadiusShare> above = shares_of(emulator, more);
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const double slope = (above[i].share - below[i].share) / (2 * step_nm);
        EXPECT_NEAR(shares[i].by_fibril_radius_nm, slope, 1e-6 * std::abs(slope) + 1e-10);
    }
}

TEST(RadiusEmulator, OfOneRadiusIsTheEmulatorOfIt) {
    EmulatorDomain domain = domain_of(8, Side::top, 25, 25);
    const RadiusEmulator emulator = made(domain);
    domain.ranges.pop_back();
    domain.sample.skin.fibril_radius_nm = std::exp(std::log(25.0));
    const Emulator plain = Emulator::build(domain);
    const Skin skin = specimen(domain, 3);
    const std::vector<EmulatedShare> expected =
        plain.respond(optical_depths(skin, extinctions(wavelengths_nm, Edition::revised)));
    Skin at = skin;
    at.fibril_radius_nm = 25;
    const std::vector<RadiusShare> shares = shares_of(emulator, at);
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) EXPECT_EQ(shares[i].share, expected[i].share);
}

TEST(RadiusEmulator, RefusesARadiusOutsideItsRange) {
    const EmulatorDomain domain = domain_of(8, Side::top, 24, 26);
    const RadiusEmulator emulator = made(domain);
    Skin skin = specimen(domain, 3);
    for (const double radius_nm : {23.9, 26.1, std::nan("")}) {
        skin.fibril_radius_nm = radius_nm;
        EXPECT_THROW((void)shares_of(emulator, skin), InputError);
    }
}

}  // namespace
}  // namespace skinfit::test
