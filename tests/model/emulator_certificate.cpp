#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "model/angular_solver.hpp"
#include "model/chromophores.hpp"
#include "model/constants.hpp"
#include "model/emulator.hpp"
#include "tests/model/physiological_box.hpp"

namespace skinfit::test {
namespace {

/// A sample at Table 1 but for what `name` says.
struct Geometry {
    std::string name;
    Sample sample;
    double incidence_deg;
    Side side;
};

void PrintTo(const Geometry& geometry, std::ostream* out) {
    *out << geometry.name;
}

std::vector<Geometry> geometries() {
    Sample printed;
    printed.edition = Edition::printed;
    Sample thin_fibrils;
    thin_fibrils.skin.fibril_radius_nm = 1.16;
    Sample thick_fibrils;
    thick_fibrils.skin.fibril_radius_nm = 60;
    Sample separated;
    separated.layers = 2;
    separated.base = {.kind = Base::Kind::index, .refractive_index = 1.0};
    Sample thin_body_part;
    thin_body_part.base.kind = Base::Kind::matched;
    return {{"revised_8deg", {}, 8, Side::top},
            {"revised_45deg", {}, 45, Side::top},
            {"printed_8deg", printed, 8, Side::top},
            {"printed_45deg", printed, 45, Side::top},
            {"radius_1_16_nm", thin_fibrils, 8, Side::top},
            {"radius_60_nm", thick_fibrils, 8, Side::top},
            {"two_layers", separated, 0, Side::top},
            {"two_layers_transmitted", separated, 0, Side::bottom},
            {"matched_base", thin_body_part, 8, Side::top},
            {"matched_base_transmitted", thin_body_part, 8, Side::bottom}};
}

class EmulatorCertificate : public testing::TestWithParam<Geometry> {};

TEST_P(EmulatorCertificate, HoldsOnSobolPointsOfThePhysiologicalBox) {
    const Geometry& geometry = GetParam();
    const EmulatorDomain domain{.sample = geometry.sample,
                                .incidence_rad = geometry.incidence_deg * rad_per_deg,
                                .side = geometry.side,
                                .wavelengths_nm = {400, 420, 450, 480, 510, 540, 560, 580, 620, 660, 700},
                                .ranges = physiological_box};
    const Emulator emulator = Emulator::build(domain);
    std::vector<Skin> skins;
    constexpr int points = 1000;
    constexpr int corners = 32;
    boost::random::sobol sobol(domain.ranges.size());
    for (int number = 0; number < points + corners; ++number) {
        ParameterValues values{.skin = domain.sample.skin, .instrument = {}};
        for (std::size_t i = 0; i < domain.ranges.size(); ++i) {
            const double drawn = static_cast<double>(sobol()) / static_cast<double>(boost::random::sobol::max());
            const double corner = (number - points) >> i & 1;
            const double place = number >= points ? corner : number % 2 == 0 ? drawn : drawn * drawn * drawn;
            value_of(values, domain.ranges[i].parameter) =
                std::lerp(domain.ranges[i].lower, domain.ranges[i].upper, place);
        }
        skins.push_back(values.skin);
    }
    const AngularSolver solver(domain.sample, {.incidence_rad = domain.incidence_rad});
    std::vector<double> worst(skins.size());
    tbb::parallel_for(std::size_t{0}, skins.size(), [&](std::size_t number) {
        std::vector<PerLayer<double>> depths;
        for (const double wavelength_nm : domain.wavelengths_nm) {
            depths.push_back(optical_depth(skins[number], Extinction::at(wavelength_nm, domain.sample.edition)));
        }
        const std::vector<EmulatedShare> shares = emulator.respond(depths);
        const AngularSolver exact = solver.with(skins[number]);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const AngularResponse response = exact.shares(domain.wavelengths_nm[i]);
            const double expected = geometry.side == Side::top ? response.reflected.share : response.transmitted.share;
            worst[number] = std::max(worst[number], std::abs(shares[i].share - expected));
        }
    });
    const double largest = *std::ranges::max_element(worst);
    RecordProperty("largest_deviation", std::to_string(largest));
    RecordProperty("certified_error", std::to_string(emulator.certified_error()));
    std::printf("%s: largest deviation %.2e, certified %.2e\n", geometry.name.c_str(), largest,
                emulator.certified_error());
    EXPECT_LE(largest, emulator.certified_error());
    constexpr double promised = 2e-4;  // of the emulator and of the solver together
    EXPECT_LE(emulator.certified_error(), promised);
}

INSTANTIATE_TEST_SUITE_P(Geometries, EmulatorCertificate, testing::ValuesIn(geometries()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace skinfit::test
