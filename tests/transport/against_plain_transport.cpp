#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/constants.hpp"
#include "model/random.hpp"
#include "tests/support/statistics.hpp"
#include "tests/transport/plain_transport.hpp"
#include "transport/layered_skin.hpp"

/// Recorded paths say of any absorption, port and cone what photons do that are absorbed on their way.
namespace skinfit {
namespace {

using Fate = test::PlainPhoton::Fate;

constexpr std::uint64_t photons = 60'000;
constexpr double spot_cm = 0.02;

struct Comparison {
    TurbidStack stack;
    PerTurbidLayer absorption;
    double incidence_rad;
};

double z_against(const PhotonMean& mean, std::uint64_t count, double white = 1.0) {
    const test::Estimate plain = test::share_of(count, photons);
    return test::z_between(test::Estimate{mean.value, mean.standard_error},
                           test::Estimate{plain.value / white, plain.standard_error / white});
}

/// How many leave through the top, within `port_cm` of the middle of a spot that each meets somewhere.
std::uint64_t count_in_port(const std::vector<test::PlainPhoton>& ends, double port_cm) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const FourUniforms xi = RandomRay(99, i).uniforms(0, 0);
        const double radius = spot_cm * std::sqrt(xi[0]);
        const double x = ends[i].x + radius * std::cos(2.0 * pi * xi[1]);
        const double y = ends[i].y + radius * std::sin(2.0 * pi * xi[1]);
        count += ends[i].fate == Fate::top && std::hypot(x, y) < port_cm ? 1 : 0;
    }
    return count;
}

/// The z of everything that the two can be asked about; `absorption` is what the paths are told.
std::vector<double> compared(const Comparison& c, const PerTurbidLayer& absorption) {
    const std::vector<test::PlainPhoton> ends =
        test::plain_transport(c.stack, c.absorption, c.incidence_rad, photons, 11);
    const auto counted = [&](Fate fate) { return test::count_of(ends, fate); };
    EXPECT_EQ(counted(Fate::first_reflection) + counted(Fate::top) + counted(Fate::bottom) + counted(Fate::absorbed),
              photons);
    PerTurbidLayer least = c.absorption;
    for (double& each : least) each *= 0.5;
    const PhotonPaths paths = PhotonPaths::trace(
        c.stack, {.incidence_rad = c.incidence_rad, .photons = photons, .seed = 12, .least_absorption_per_cm = least});
    const double cone = 0.6;
    const double white = std::pow(std::sin(cone), 2);
    const std::vector<Gathering> gatherings = {
        {},
        {.specular = Specular::excluded},
        {.spot_radius_cm = spot_cm, .port_radius_cm = spot_cm, .specular = Specular::excluded},
        {.spot_radius_cm = spot_cm, .port_radius_cm = 2.5 * spot_cm, .specular = Specular::excluded},
        {.viewing_cone_rad = cone, .specular = Specular::excluded}};
    const std::vector<PhotonMean> top = paths.shares(Side::top, {&absorption, 1}, gatherings)[0];
    const PhotonMean bottom = paths.shares(Side::bottom, {&absorption, 1}, {gatherings.data(), 1})[0][0];
    const auto seen = static_cast<std::uint64_t>(std::ranges::count_if(
        ends, [&](const auto& end) { return end.fate == Fate::top && end.cosine > std::cos(cone); }));
    return {z_against(top[0], counted(Fate::first_reflection) + counted(Fate::top)),
            z_against(top[1], counted(Fate::top)),
            z_against(top[2], count_in_port(ends, spot_cm)),
            z_against(top[3], count_in_port(ends, 2.5 * spot_cm)),
            z_against(top[4], seen, white),
            z_against(bottom, counted(Fate::bottom))};
}

std::vector<Comparison> comparisons() {
    return {
        {.stack = {.layers = {{60, 0.6, 1.5, 0.01}, {150, 0.8, 1.35, 0.04}}, .index_below = 1.2},
         .absorption = {20, 3},
         .incidence_rad = 45 * rad_per_deg},
        {.stack = {.layers = {{200, -0.3, 1.0, 0.005}, {0, 0, 1.4, 0.01}, {80, 0.5, 1.4, 0.03}}, .index_above = 1.3},
         .absorption = {5, 15, 8},
         .incidence_rad = 0.0}};
}

TEST(AgainstPlainTransport, RecordedPathsSayWhatAbsorbedPhotonsDo) {
    for (const Comparison& c : comparisons()) {
        EXPECT_GT(test::family_wise_p_value(compared(c, c.absorption)), test::passing_p_value);
    }
}

TEST(AgainstPlainTransport, AnAbsorptionTooHighIsFound) {
    const Comparison c = comparisons()[0];
    PerTurbidLayer higher = c.absorption;
    higher[1] *= 1.5;
    EXPECT_LT(test::family_wise_p_value(compared(c, higher)), test::passing_p_value) << "50 % more passes";
}

TEST(AgainstPlainTransport, DarkSkinInBlueLightReflectsTheSame) {
    LayeredSkin skin;
    skin.melanosome_fraction = 0.5;
    const TurbidStack stack = turbid_stack(skin, 400);
    const PerTurbidLayer absorption = layer_absorption_per_cm(skin, TissueExtinction::at(400));
    EXPECT_GT(test::family_wise_p_value(compared({stack, absorption, 8 * rad_per_deg}, absorption)),
              test::passing_p_value);
}

}  // namespace
}  // namespace skinfit
