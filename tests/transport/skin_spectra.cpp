#include "transport/skin_spectra.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/constants.hpp"
#include "tests/support/statistics.hpp"
#include "transport/scattering_nodes.hpp"

namespace skinfit {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double interpolated(const ScatteringNodes& nodes, std::size_t skin, double (*law)(double)) {
    double sum = 0.0;
    for (const NodePart& part : nodes.parts[skin]) sum += part.weight * law(nodes.reduced_per_cm[part.node]);
    return sum;
}

TEST(ScatteringNodes, AreTheScatteringsThemselvesWithoutARatioOrWhereTheseAreFew) {
    const std::vector<double> reduced = {30, 10, 30, 20};
    for (const std::optional<double> ratio : {std::optional<double>(), std::optional<double>(1.3)}) {
        const ScatteringNodes nodes = scattering_nodes(reduced, ratio);
        EXPECT_EQ(nodes.reduced_per_cm, (std::vector<double>{10, 20, 30}));
        for (std::size_t i = 0; i < reduced.size(); ++i) {
            ASSERT_EQ(nodes.parts[i].size(), 1U);
            EXPECT_EQ(nodes.reduced_per_cm[nodes.parts[i][0].node], reduced[i]);
            EXPECT_EQ(nodes.parts[i][0].weight, 1.0);
        }
    }
}

TEST(ScatteringNodes, ReproduceEveryCubicInTheLogarithm) {
    std::vector<double> reduced;
    for (int i = 0; i <= 50; ++i) reduced.push_back(8.0 + 3.0 * i);
    const ScatteringNodes nodes = scattering_nodes(reduced, 1.5);
    ASSERT_LT(nodes.reduced_per_cm.size(), reduced.size());
    for (std::size_t i = 1; i < nodes.reduced_per_cm.size(); ++i) {
        EXPECT_LE(nodes.reduced_per_cm[i] / nodes.reduced_per_cm[i - 1], 1.5 * (1 + 8 * epsilon));
    }
    const auto cubic = [](double reduced_per_cm) {
        const double x = std::log(reduced_per_cm);
        return 1.0 + x * (0.5 - x * (0.2 - 0.03 * x));
    };
    for (std::size_t i = 0; i < reduced.size(); ++i) {
        // Four terms with weights below 2, of values below 2.
        EXPECT_NEAR(interpolated(nodes, i, cubic), cubic(reduced[i]), 64 * epsilon);
    }
}

/// A sphere, a small port and a view along the normal.
SkinTransportOptions three_instruments() {
    return {.gatherings = {{},
                           {.spot_radius_cm = 0.25, .port_radius_cm = 0.25},
                           {.viewing_cone_rad = 25 * rad_per_deg, .specular = Specular::excluded}},
            .photons = 3000};
}

std::vector<LayeredSkin> some_skins(std::size_t count) {
    std::vector<LayeredSkin> skins(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto place = static_cast<double>(i) / static_cast<double>(count);
        skins[i].scattering.at_500_nm_per_cm = 25 + 60 * place;
        skins[i].melanosome_fraction = 0.02 + 0.1 * place * place;
    }
    return skins;
}

TEST(SkinSpectra, AreTheReadingsOfOneTrace) {
    const std::vector<LayeredSkin> skins = some_skins(1);
    const SkinTransportOptions options = three_instruments();
    const SkinReadings spectra = skin_spectra(skins, {450, 650}, options);
    const PerTurbidLayer absorption = layer_absorption_per_cm(skins[0], TissueExtinction::at(650));
    const PhotonPaths paths = PhotonPaths::trace(turbid_stack(skins[0], 650), {.incidence_rad = options.incidence_rad,
                                                                               .photons = options.photons,
                                                                               .seed = options.seed,
                                                                               .least_absorption_per_cm = absorption});
    const auto shares = paths.shares(Side::top, {&absorption, 1}, options.gatherings);
    for (std::size_t g = 0; g < 3; ++g) {
        ASSERT_EQ(spectra[0][g].size(), 2U);
        // The scattering passes through a logarithm's inverse or a power of one.
        EXPECT_DOUBLE_EQ(spectra[0][g][1].value, shares[0][g].value);
        EXPECT_DOUBLE_EQ(spectra[0][g][1].standard_error, shares[0][g].standard_error);
    }
    EXPECT_LT(spectra[0][1][1].value, spectra[0][0][1].value) << "a small port loses no light";
}

TEST(SkinSpectra, DependNeitherOnThreadsNorOnOtherWavelengths) {
    const std::vector<LayeredSkin> skins = some_skins(3);
    const auto spectra = [&](std::size_t threads, const std::vector<double>& wavelengths_nm) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return skin_spectra(skins, wavelengths_nm, three_instruments());
    };
    const SkinReadings one = spectra(1, {450, 650});
    const SkinReadings two = spectra(2, {650, 450});
    for (std::size_t skin = 0; skin < skins.size(); ++skin) {
        for (std::size_t g = 0; g < 3; ++g) {
            EXPECT_EQ(one[skin][g][0].value, two[skin][g][1].value);
            EXPECT_EQ(one[skin][g][1].value, two[skin][g][0].value);
        }
    }
}

TEST(SkinSpectra, SharedTracesAgreeWithOwnOnes) {
    const std::vector<LayeredSkin> skins = some_skins(12);
    SkinTransportOptions options = three_instruments();
    options.photons = 8000;
    const SkinReadings own = skin_spectra(skins, {620}, options);
    options.seed = 2;
    options.node_ratio = 1.35;
    const SkinReadings shared = skin_spectra(skins, {620}, options);
    std::vector<double> z;
    for (std::size_t skin = 0; skin < skins.size(); ++skin) {
        for (std::size_t g = 0; g < 3; ++g) {
            const PhotonMean& a = own[skin][g][0];
            const PhotonMean& b = shared[skin][g][0];
            EXPECT_GT(b.standard_error, 0.0);
            z.push_back(
                test::z_between(test::Estimate{a.value, a.standard_error}, test::Estimate{b.value, b.standard_error}));
        }
    }
    EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value);
}

}  // namespace
}  // namespace skinfit
