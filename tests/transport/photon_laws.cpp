#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "model/constants.hpp"
#include "model/random.hpp"
#include "tests/support/statistics.hpp"
#include "transport/henyey_greenstein.hpp"
#include "transport/photon_paths.hpp"

/// The transport against published values and closed forms.
namespace skinfit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double z_of(const PhotonMean& mean, double expected) {
    return (mean.value - expected) / mean.standard_error;
}

double z_between(const PhotonMean& a, const PhotonMean& b) {
    return test::z_between(test::Estimate{a.value, a.standard_error}, test::Estimate{b.value, b.standard_error});
}

struct SlabShares {
    PhotonMean reflectance;
    PhotonMean transmittance;
};

SlabShares shares_of_slab(const TurbidStack& stack, double absorption_per_cm, PhotonOptions options) {
    const PhotonPaths paths = PhotonPaths::trace(stack, options);
    const PerTurbidLayer absorption{absorption_per_cm};
    const Gathering all;
    return {paths.shares(Side::top, {&absorption, 1}, {&all, 1})[0][0],
            paths.shares(Side::bottom, {&absorption, 1}, {&all, 1})[0][0]};
}

TEST(HenyeyGreenstein, CosinesFollowTheirLaw) {
    for (const double g : {-0.5, 0.0, 1e-9, 0.3, 0.8, 0.98}) {
        std::vector<double> shares;
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            const double cosine = henyey_greenstein_cosine(g, RandomRay(7, i).uniforms(0, 0)[1]);
            // The share below a cosine, [HENYEY41] integrated; isotropic in the limit.
            shares.push_back(std::fabs(g) < 1e-6
                                 ? 0.5 * (1.0 + cosine)
                                 : (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * cosine) - 1 / (1 + g)));
        }
        EXPECT_GT(test::uniformity_p_value(shares), test::passing_p_value) << g;
    }
}

TEST(PhotonLaws, AMatchedSlabHasThePublishedShares) {
    // [VANDEHULST80], as [WANG95] has it.
    const auto slab = [](double anisotropy) {
        return shares_of_slab({.layers = {{90, anisotropy, 1, 0.02}}}, 10, {.photons = 400'000});
    };
    const SlabShares found = slab(0.75);
    const std::vector<double> z = {z_of(found.reflectance, 0.09734), z_of(found.transmittance, 0.66096)};
    EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value);
    EXPECT_LT(test::two_sided_p_value(z_of(slab(0.74).reflectance, 0.09734)), test::passing_p_value)
        << "an anisotropy too low by 0.01 passes";
}

TEST(PhotonLaws, AHalfSpaceOfHigherIndexHasThePublishedReflectance) {
    // [GIOVANELLI55], as [WANG95] has it, with the light that the surface reflects.
    const auto half_space = [](double index) {
        return shares_of_slab({.layers = {{90, 0, index, infinity}}}, 10,
                              {.photons = 200'000, .least_absorption_per_cm = {10}});
    };
    EXPECT_GT(test::two_sided_p_value(z_of(half_space(1.5).reflectance, 0.2600)), test::passing_p_value);
    EXPECT_LT(test::two_sided_p_value(z_of(half_space(1.45).reflectance, 0.2600)), test::passing_p_value)
        << "an index too low by 0.05 passes";
}

TEST(PhotonLaws, AClearPlateReflectsWithinItself) {
    // The sum of the geometric series of internal reflections.
    const TurbidStack plate{.layers = {{0, 0, 1.5, 0.1}}};
    const double surface = 0.04;
    const double dimmed = std::exp(-0.1 * 4.0);
    const double transmittance = std::pow(1 - surface, 2) * dimmed / (1 - std::pow(surface * dimmed, 2));
    const SlabShares found = shares_of_slab(plate, 4.0, {.photons = 100'000});
    const std::vector<double> z = {z_of(found.transmittance, transmittance),
                                   z_of(found.reflectance, surface + surface * dimmed * transmittance)};
    EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value);
}

TEST(PhotonLaws, RouletteChangesNoMean) {
    const TurbidStack slab{.layers = {{100, 0.5, 1.4, 0.2}}};
    const PhotonOptions without{.photons = 100'000, .seed = 2};
    PhotonOptions with{.photons = 100'000, .seed = 3};
    with.least_absorption_per_cm[0] = 8.0;
    const PhotonPaths played = PhotonPaths::trace(slab, with);
    EXPECT_GT(played.lost(), with.photons / 20) << "there was no roulette to speak of";
    for (const double absorption : {2.0, 8.0, 20.0}) {
        const SlabShares a = shares_of_slab(slab, absorption, without);
        const SlabShares b = shares_of_slab(slab, absorption, with);
        const std::vector<double> z = {z_between(a.reflectance, b.reflectance),
                                       z_between(a.transmittance, b.transmittance)};
        EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value) << absorption;
    }
}

/// Chandrasekhar's H for isotropic scattering at the midpoints of equal parts of (0, 1), and what it says of light that
/// leaves a half space lit at cosine `lit`. [CHANDRASEKHAR60, Chap. V]
class HalfSpace {
public:
    HalfSpace(double albedo, std::size_t points) : albedo_(albedo), h_(points, 1.0) {
        for (int iteration = 0; iteration < 60; ++iteration) {
            std::vector<double> next;
            for (std::size_t i = 0; i < points; ++i) next.push_back(h(cosine(i)));
            h_ = next;
        }
    }
    /// The share that leaves with a cosine of at least `least`, which lies between two points.
    [[nodiscard]] double share(double lit, double least) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < h_.size(); ++i) {
            if (cosine(i) > least) sum += cosine(i) * h_[i] / (cosine(i) + lit);
        }
        return 0.5 * albedo_ * h(lit) * sum / static_cast<double>(h_.size());
    }

private:
    [[nodiscard]] double cosine(std::size_t i) const {
        return (static_cast<double>(i) + 0.5) / static_cast<double>(h_.size());
    }
    [[nodiscard]] double h(double at) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < h_.size(); ++i) sum += cosine(i) * h_[i] / (at + cosine(i));
        return 1.0 / (std::sqrt(1.0 - albedo_) + 0.5 * albedo_ * sum / static_cast<double>(h_.size()));
    }

    double albedo_;
    std::vector<double> h_;
};

TEST(PhotonLaws, LightLeavesAHalfSpaceInTheDirectionsOfChandrasekhar) {
    const HalfSpace coarse(0.9, 200);
    const HalfSpace fine(0.9, 400);
    const PerTurbidLayer absorption{10};
    for (const double lit : {1.0, 0.4}) {
        const PhotonPaths paths = PhotonPaths::trace(
            {.layers = {{90, 0, 1, infinity}}},
            {.incidence_rad = std::acos(lit), .photons = 200'000, .seed = 9, .least_absorption_per_cm = absorption});
        std::vector<double> z;
        for (const double least : {0.0, 0.2, 0.5, 0.8, 0.9}) {
            const Gathering cone{.viewing_cone_rad = std::acos(least)};
            const PhotonMean mean = paths.shares(Side::top, {&absorption, 1}, {&cone, 1})[0][0];
            const double white = 1.0 - least * least;
            EXPECT_LT(std::abs(fine.share(lit, least) - coarse.share(lit, least)) / white, 0.2 * mean.standard_error);
            z.push_back(z_of(mean, fine.share(lit, least) / white));
        }
        EXPECT_GT(test::family_wise_p_value(z), test::passing_p_value) << lit;
    }
}

}  // namespace
}  // namespace skinfit
