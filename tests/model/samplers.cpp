#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "model/random.hpp"
#include "model/scattering.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

/// A sampler turned into its own law: draws are uniform in 0 to 1 if, and only if, sampler and law agree.
struct Sampler {
    std::string name;
    std::function<double(const FourUniforms&)> share_of_draw;
};

Sampler forward(const std::string& name, Layer layer, double wavelength_nm) {
    return {name, [scattering = ForwardScattering(layer, wavelength_nm)](const FourUniforms& xi) {
                return scattering.share_within(scattering.polar_angle(xi[0]));
            }};
}

Sampler rayleigh(const std::string& name, Edition edition) {
    return {name, [scattering = RayleighScattering(edition)](const FourUniforms& xi) {
                return scattering.share_below(scattering.cosine(xi[0]));
            }};
}

Sampler fold_warp(const std::string& name, Edition edition, double sigma) {
    return {name,
            [warp = FoldWarp(edition, sigma)](const FourUniforms& xi) { return warp.share_below(warp.cosine(xi[0])); }};
}

const std::vector<Sampler>& samplers() {
    static const std::vector<Sampler> all = {
        forward("stratum_corneum_below_table", Layer::stratum_corneum, 251),
        forward("stratum_corneum_278_nm", Layer::stratum_corneum, 278),
        forward("stratum_corneum_436_nm", Layer::stratum_corneum, 436),
        forward("stratum_corneum_500_nm", Layer::stratum_corneum, 500),
        forward("stratum_corneum_above_table", Layer::stratum_corneum, 700),
        forward("epidermis_below_table", Layer::epidermis, 260),
        forward("epidermis_400_nm", Layer::epidermis, 400),
        forward("epidermis_546_nm", Layer::epidermis, 546),
        forward("epidermis_above_table", Layer::epidermis, 700),
        {"diffuse",
         [](const FourUniforms& xi) { return DiffuseScattering::share_below(DiffuseScattering::cosine(xi[0])); }},
        rayleigh("rayleigh_printed", Edition::printed),
        rayleigh("rayleigh_revised", Edition::revised),
        fold_warp("fold_warp_printed_0_25", Edition::printed, 0.25),
        fold_warp("fold_warp_printed_0_75", Edition::printed, 0.75),
        fold_warp("fold_warp_printed_1", Edition::printed, 1.0),
        fold_warp("fold_warp_revised_0_25", Edition::revised, 0.25),
        fold_warp("fold_warp_revised_0_75", Edition::revised, 0.75),
        fold_warp("fold_warp_revised_1", Edition::revised, 1.0),
    };
    return all;
}

constexpr std::uint64_t draws = 4'000'000;

/// The p-value of `draws` proposals, the first number of each raised to `power`.
double p_value(const std::function<double(const FourUniforms&)>& share_of_draw, double power = 1.0) {
    std::vector<double> shares;
    shares.reserve(draws);
    for (std::uint64_t ray = 0; ray < draws; ++ray) {
        FourUniforms xi = RandomRay(20, ray).uniforms(1, 0);
        if (power != 1.0) xi[0] = std::pow(xi[0], power);
        shares.push_back(std::clamp(share_of_draw(xi), 0.0, 1.0));  // rounding may step over the ends
    }
    return test::uniformity_p_value(shares);
}

class SamplerLaw : public testing::TestWithParam<std::size_t> {};

TEST_P(SamplerLaw, DrawsFollowTheLaw) {
    EXPECT_GT(p_value(samplers()[GetParam()].share_of_draw), test::passing_p_value);
}

TEST_P(SamplerLaw, OnePercentInTheExponentOfXiIsSeen) {
    // Raising xi to 1.01 changes a density by 1 % rms: a noncentrality of draws * 1e-4 = 400 at 49 degrees of freedom.
    EXPECT_LT(p_value(samplers()[GetParam()].share_of_draw, 1.01), test::passing_p_value);
}

INSTANTIATE_TEST_SUITE_P(All, SamplerLaw, testing::Range<std::size_t>(0, 18),
                         [](const auto& test) { return samplers()[test.param].name; });

TEST(SamplerLaws, AnglesOnePercentTooWideAreSeen) {
    const ForwardScattering scattering(Layer::epidermis, 500);
    EXPECT_LT(
        p_value([&](const FourUniforms& xi) { return scattering.share_within(1.01 * scattering.polar_angle(xi[0])); }),
        test::passing_p_value);
}

TEST(SamplerLaws, RayleighAnglesOfTheOtherEditionAreSeen) {
    const RayleighScattering printed(Edition::printed);
    const RayleighScattering revised(Edition::revised);
    EXPECT_LT(p_value([&](const FourUniforms& xi) { return revised.share_below(printed.cosine(xi[0])); }),
              test::passing_p_value);
}

using Vector = std::array<double, 3>;

TEST(DeflectedCosine, IsTheHeightOfTheRotatedVector) {
    for (std::uint64_t ray = 0; ray < 10'000; ++ray) {
        const FourUniforms xi = RandomRay(5, ray).uniforms(0, 0);
        const double cosine = xi[0];
        const double polar = pi * xi[1];
        const double azimuth = 2 * pi * xi[2];
        // The ray, and two unit vectors across it; `up` in the plane of the normal (0, 0, 1).
        const double sine = std::sqrt(1 - cosine * cosine);
        const double heading = 2 * pi * xi[3];
        const Vector along = {sine * std::cos(heading), sine * std::sin(heading), cosine};
        const Vector up = {-cosine * std::cos(heading), -cosine * std::sin(heading), sine};
        const Vector across = {-std::sin(heading), std::cos(heading), 0.0};
        Vector rotated{};
        for (std::size_t i = 0; i < 3; ++i) {
            rotated[i] = std::cos(polar) * along[i] +
                         std::sin(polar) * (std::cos(azimuth) * up[i] + std::sin(azimuth) * across[i]);
        }
        // Terms of at most 1 with a handful of roundings each.
        EXPECT_NEAR(deflected_cosine(cosine, std::cos(polar), std::sin(polar), std::cos(azimuth)), rotated[2], 1e-15);
        EXPECT_NEAR(std::hypot(rotated[0], rotated[1], rotated[2]), 1.0, 1e-14);
    }
}

}  // namespace
}  // namespace skinfit
