#include "model/emulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/input_error.hpp"
#include "model/angular_solver.hpp"
#include "model/chromophores.hpp"
#include "tests/model/angular_samples.hpp"
#include "tests/model/physiological_box.hpp"

namespace skinfit::test {
namespace {

const std::vector<double> wavelengths_nm = {405, 433, 545, 577, 700};

EmulatorDomain physiological(const Sample& sample, double incidence_rad, Side side) {
    return {.sample = sample,
            .incidence_rad = incidence_rad,
            .side = side,
            .wavelengths_nm = wavelengths_nm,
            .ranges = physiological_box};
}

std::vector<PerLayer<double>> depths(const Skin& skin, Edition edition) {
    std::vector<PerLayer<double>> result;
    for (const double wavelength_nm : wavelengths_nm) {
        result.push_back(optical_depth(skin, Extinction::at(wavelength_nm, edition)));
    }
    return result;
}

class EveryEmulator : public testing::TestWithParam<AngularCase> {};

TEST_P(EveryEmulator, StaysWithinItsCertifiedErrorOfTheSolver) {
    const Sample& sample = GetParam().sample;
    for (const Side side : {Side::top, Side::bottom}) {
        const EmulatorDomain domain = physiological(sample, GetParam().incidence_rad, side);
        const Emulator emulator = Emulator::build(domain);
        const AngularSolver solver(sample, {.incidence_rad = domain.incidence_rad});
        EXPECT_EQ(emulator.surface_share(), solver.shares(500).surface.share);
        double largest = 0.0;
        for (int number = 1; number <= 20; ++number) {
            const Skin skin = specimen(domain, number);
            const std::vector<EmulatedShare> shares = emulator.respond(depths(skin, sample.edition));
            const AngularSolver exact = solver.with(skin);
            for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
                const AngularResponse response = exact.shares(wavelengths_nm[i]);
                const double expected = side == Side::top ? response.reflected.share : response.transmitted.share;
                EXPECT_NEAR(shares[i].share, expected, emulator.certified_error(i));
                largest = std::max(largest, std::abs(shares[i].share - expected));
            }
        }
        constexpr double promised = 1e-4;  // of the series; the certificate holds the solver's own error too
        EXPECT_LE(largest, promised);
    }
}

TEST_P(EveryEmulator, DerivativesAreThoseOfItsShares) {
    const Sample& sample = GetParam().sample;
    const EmulatorDomain domain = physiological(sample, GetParam().incidence_rad, Side::top);
    const Emulator emulator = Emulator::build(domain);
    const std::vector<PerLayer<double>> at = depths(specimen(domain, 6), sample.edition);
    const std::vector<EmulatedShare> shares = emulator.respond(at);
    for (std::size_t layer = 1; layer < static_cast<std::size_t>(sample.layers); ++layer) {
        const auto central = [&](double relative) {
            auto above = at;
            auto below = at;
            for (std::size_t i = 0; i < at.size(); ++i) {
                above[i][layer] *= 1.0 + relative;
                below[i][layer] *= 1.0 - relative;
            }
            const auto high = emulator.respond(above);
            const auto low = emulator.respond(below);
            std::vector<double> slope;
            for (std::size_t i = 0; i < at.size(); ++i) {
                slope.push_back((high[i].share - low[i].share) / (2.0 * relative * at[i][layer]));
            }
            return slope;
        };
        const std::vector<double> near = central(1e-4);
        const std::vector<double> far = central(2e-4);
        for (std::size_t i = 0; i < at.size(); ++i) {
            // The truncation error of a central difference is a third of its change when the step doubles; shares are
            // sums of some hundred terms below one.
            const double bound = std::abs(far[i] - near[i]) + 1e-14 / (1e-4 * at[i][layer]);
            EXPECT_NEAR(shares[i].by_optical_depth[layer], near[i], bound) << layer << " " << wavelengths_nm[i];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Angular, EveryEmulator, testing::ValuesIn(all_angular_cases()), case_name);

TEST(Emulator, RefusesDepthsOutsideItsDomain) {
    const EmulatorDomain domain = physiological({}, 0.1, Side::top);
    const Emulator emulator = Emulator::build(domain);
    Skin darker = domain.sample.skin;
    darker.melanosome_fraction = 0.51;
    try {
        (void)emulator.respond(depths(darker, domain.sample.edition));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("epidermis"), std::string::npos);
    }
}

TEST(Emulator, CertifiesWhereALayerMayNotAbsorbAtAll) {
    EmulatorDomain domain = physiological({}, 0.1, Side::top);
    domain.wavelengths_nm = {545};
    domain.sample.skin.eumelanin_g_per_l = 0.0;
    domain.sample.skin.pheomelanin_g_per_l = 0.0;
    std::ranges::find(domain.ranges, Parameter::melanosome_fraction, &ParameterRange::parameter)->upper = 1.0;
    const Emulator emulator = Emulator::build(domain);
    constexpr double hundredth = 0.01;  // no part of the promise, which is for skin
    EXPECT_LE(emulator.certified_error(), hundredth);
    const AngularSolver solver(domain.sample, {.incidence_rad = domain.incidence_rad});
    for (int number = 1; number <= 20; ++number) {
        const Skin skin = specimen(domain, number);
        const PerLayer<double> at = optical_depth(skin, Extinction::at(545, domain.sample.edition));
        EXPECT_NEAR(emulator.respond(std::vector{at})[0].share, solver.with(skin).shares(545).reflected.share,
                    emulator.certified_error(0));
    }
}

TEST(Emulator, RefusesParametersThatSteer) {
    EmulatorDomain domain = physiological({}, 0.1, Side::top);
    domain.ranges.push_back({Parameter::fibril_radius_nm, 20, 30});
    EXPECT_THROW((void)Emulator::build(domain), InputError);
}

TEST(Emulator, CoversEveryParameterThatAbsorbs) {
    EmulatorDomain domain = physiological({}, 0.1, Side::top);
    domain.wavelengths_nm = {433, 577};
    for (const Parameter parameter :
         {Parameter::stratum_corneum_carotene_g_per_l, Parameter::epidermis_carotene_g_per_l,
          Parameter::epidermis_thickness_cm, Parameter::hemoglobin_g_per_l}) {
        domain.ranges.push_back({parameter, info(parameter).lower, info(parameter).upper});
    }
    const Emulator emulator = Emulator::build(domain);
    constexpr double promised = 2e-4;  // of the emulator and of the solver together
    EXPECT_LE(emulator.certified_error(), promised);
    const AngularSolver solver(domain.sample, {.incidence_rad = domain.incidence_rad});
    for (int number = 1; number <= 20; ++number) {
        const Skin skin = specimen(domain, number);
        std::vector<PerLayer<double>> at;
        for (const double wavelength_nm : domain.wavelengths_nm) {
            at.push_back(optical_depth(skin, Extinction::at(wavelength_nm, domain.sample.edition)));
        }
        const std::vector<EmulatedShare> shares = emulator.respond(at);
        for (std::size_t i = 0; i < at.size(); ++i) {
            const AngularResponse exact = solver.with(skin).shares(domain.wavelengths_nm[i]);
            EXPECT_NEAR(shares[i].share, exact.reflected.share, emulator.certified_error(i));
        }
    }
}

}  // namespace
}  // namespace skinfit::test
