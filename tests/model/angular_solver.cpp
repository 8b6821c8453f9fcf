#include "model/angular_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/input_error.hpp"
#include "model/chromophores.hpp"
#include "model/viewing_cone.hpp"
#include "tests/model/angular_samples.hpp"

namespace skinfit {
namespace {

// Backward-stable elimination of some 200 unknowns whose matrix has a condition number of order 10:
// 200 * 10 * 2.2e-16 = 5e-13.
constexpr double rounding = 1e-12;
constexpr double cone_rad = 0.2;

class EverySample : public testing::TestWithParam<AngularCase> {
protected:
    [[nodiscard]] static AngularSolver solver(const Skin& skin) {
        Sample sample = GetParam().sample;
        sample.skin = skin;
        return {sample, {.incidence_rad = GetParam().incidence_rad, .viewing_cone_rad = cone_rad}};
    }
};

TEST_P(EverySample, ConservesLight) {
    const AngularSolver angular = solver(GetParam().sample.skin);
    for (double wavelength_nm = 400; wavelength_nm <= 700; wavelength_nm += 50) {
        const AngularResponse response = angular.shares(wavelength_nm);
        const double absorbed = std::accumulate(response.absorbed.begin(), response.absorbed.end(), 0.0);
        EXPECT_NEAR(response.surface.share + response.reflected.share + response.transmitted.share + absorbed, 1.0,
                    rounding);
        for (const double share : response.absorbed) EXPECT_GE(share, 0.0);
    }
}

TEST_P(EverySample, DerivativesMatchDifferences) {
    constexpr double wavelength_nm = 580;
    Skin skin = GetParam().sample.skin;
    skin.melanin_slope = 0.4;
    skin.whole_blood_share = 0.3;
    skin.dermal_bilirubin_g_per_l = 0.1;
    skin.lateral_loss_per_cm = 0.2;
    const AngularResponse response = solver(skin).respond(wavelength_nm);
    for (const ParameterInfo& row : parameter_table()) {
        const auto p = static_cast<std::size_t>(row.parameter);
        // Small, since the tables of scattering angles have knots, at which a share bends.
        const double step = 1e-5 * value_of({.skin = skin, .instrument = {}}, row.parameter);
        const auto at = [&](double change) {
            ParameterValues values{.skin = skin, .instrument = {}};
            value_of(values, row.parameter) += change;
            return solver(values.skin).shares(wavelength_nm);
        };
        if (step == 0.0) {  // the instrument's offsets
            EXPECT_EQ(response.reflected.by_parameter[p], 0.0);
            continue;
        }
        const std::array<AngularResponse, 4> points = {at(-2.0 * step), at(-step), at(step), at(2.0 * step)};
        for (const auto share : {&AngularResponse::surface, &AngularResponse::reflected, &AngularResponse::transmitted,
                                 &AngularResponse::viewed}) {
            const double near = ((points[2].*share).share - (points[1].*share).share) / (2.0 * step);
            const double far = ((points[3].*share).share - (points[0].*share).share) / (4.0 * step);
            // The truncation error of a central difference is a third of its change when the step doubles.
            const double noise = rounding / (share == &AngularResponse::viewed ? white_share(cone_rad) : 1.0);
            const double bound = std::abs(far - near) + noise / step;
            EXPECT_NEAR((response.*share).by_parameter[p], near, bound) << row.name;
        }
    }
}

TEST_P(EverySample, RespondsTheSameWithAndWithoutDerivatives) {
    const AngularSolver angular = solver(GetParam().sample.skin);
    EXPECT_EQ(angular.shares(500).reflected.share, angular.respond(500).reflected.share);
    EXPECT_EQ(angular.shares(500).transmitted.share, angular.respond(500).transmitted.share);
    EXPECT_EQ(angular.shares(500).viewed.share, angular.respond(500).viewed.share);
}

TEST_P(EverySample, AnotherSkinIsANewSolver) {
    Skin paler = GetParam().sample.skin;
    paler.melanosome_fraction *= 0.5;
    paler.fibril_radius_nm *= 1.1;
    Skin denser = paler;
    denser.epidermis_refractive_index += 0.01;
    for (const Skin& skin : {paler, denser}) {
        const AngularResponse fresh = solver(skin).respond(520);
        const AngularResponse reused = solver(GetParam().sample.skin).with(skin).respond(520);
        EXPECT_EQ(fresh.reflected.share, reused.reflected.share);
        EXPECT_EQ(fresh.reflected.by_parameter, reused.reflected.by_parameter);
        EXPECT_EQ(fresh.viewed.by_parameter, reused.viewed.by_parameter);
        EXPECT_EQ(fresh.transmitted.by_parameter, reused.transmitted.by_parameter);
    }
}

TEST_P(EverySample, ExitSharesAddUp) {
    // The bins are integrated apart from the whole, both within the solver's accuracy.
    constexpr double accuracy = 1e-4;
    const AngularSolver angular = solver(GetParam().sample.skin);
    const AngularResponse response = angular.shares(620);
    const std::vector<double> edges = {0.0, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 0.95, 1.0};
    const auto total = [&](Side side) {
        const std::vector<double> shares = angular.exit_shares(620, side, edges);
        return std::accumulate(shares.begin(), shares.end(), 0.0);
    };
    EXPECT_NEAR(total(Side::top), response.reflected.share, accuracy);
    EXPECT_NEAR(total(Side::bottom), response.transmitted.share, accuracy);
}

INSTANTIATE_TEST_SUITE_P(Angular, EverySample, testing::ValuesIn(all_angular_cases()), case_name);

TEST(AngularLimits, SurfaceAtNormalIncidenceReflectsByFresnelsClosedForm) {
    const AngularSolver angular(Sample{}, {.incidence_rad = 0.0});
    const double index = Skin{}.stratum_corneum_refractive_index;
    EXPECT_NEAR(angular.shares(500).surface.share, std::pow((index - 1.0) / (index + 1.0), 2), rounding);
}

TEST(AngularLimits, WithoutInterfacesTwoLayersReflectNothing) {
    Sample sample;
    sample.layers = 2;
    sample.base = {.kind = Base::Kind::index, .refractive_index = 1.0};
    sample.skin.stratum_corneum_refractive_index = 1.0;
    sample.skin.epidermis_refractive_index = 1.0;
    const AngularResponse response = AngularSolver(sample, {.incidence_rad = 0.5}).shares(500);
    EXPECT_NEAR(response.surface.share + response.reflected.share, 0.0, rounding);
    EXPECT_GT(response.transmitted.share, 0.0);
}

TEST(AngularLimits, BaseOfTheSameIndexIsAMatchedBase) {
    Sample sample;
    sample.base.kind = Base::Kind::matched;
    const AngularResponse matched = AngularSolver(sample, {}).shares(650);
    sample.base = {.kind = Base::Kind::index, .refractive_index = sample.skin.reticular_dermis_refractive_index};
    const AngularResponse same_index = AngularSolver(sample, {}).shares(650);
    EXPECT_NEAR(matched.reflected.share, same_index.reflected.share, rounding);
    EXPECT_NEAR(matched.transmitted.share, same_index.transmitted.share, rounding);
}

TEST(AngularLimits, WithoutRayleighAndMolarPigmentsTheEditionsAgree) {
    Sample sample;
    Skin& skin = sample.skin;
    skin.reticular_dermis_refractive_index = skin.papillary_dermis_refractive_index;
    skin.fibre_refractive_index = skin.papillary_dermis_refractive_index;
    skin.papillary_blood_fraction = skin.reticular_blood_fraction = 0.0;
    skin.stratum_corneum_carotene_g_per_l = skin.epidermis_carotene_g_per_l = 0.0;
    const AngularResponse revised = AngularSolver(sample, {.incidence_rad = 0.7}).shares(480);
    sample.edition = Edition::printed;
    constexpr double accuracy = 1e-4;  // of the default resolution: the editions' nodes in the dermis differ
    EXPECT_NEAR(AngularSolver(sample, {.incidence_rad = 0.7}).shares(480).reflected.share, revised.reflected.share,
                accuracy);
}

/// The integral of 2 x exp(-depth / x) over the cosines x: what a layer lets pass of diffuse light, and its derivative.
/// Exponential integrals E_2 and E_3 by their recurrence.
struct DiffusePassage {
    double share;
    double by_depth;
};
DiffusePassage diffuse_passage(double depth) {
    const double e1 = -std::expint(-depth);
    const double e2 = std::exp(-depth) - depth * e1;
    const double e3 = 0.5 * (std::exp(-depth) - depth * e2);
    return {.share = 2.0 * e3, .by_depth = -2.0 * e2};
}

TEST(AngularLimits, DiffuseDermisWithoutInterfacesPassesLightTwice) {
    Sample sample;
    Skin& skin = sample.skin;
    skin.stratum_corneum_refractive_index = skin.epidermis_refractive_index = skin.papillary_dermis_refractive_index =
        skin.reticular_dermis_refractive_index = skin.fibre_refractive_index = 1.0;
    const AngularResolution finest = AngularResolution::for_accuracy(2e-5);
    constexpr double wavelength_nm = 600;
    const auto depth = [&] { return optical_depth(skin, Extinction::at(wavelength_nm, sample.edition))[3]; };
    const AngularResponse thick = AngularSolver(sample, {.resolution = finest}).respond(wavelength_nm);
    const DiffusePassage through_thick = diffuse_passage(depth());
    skin.reticular_dermis_thickness_cm = 0.06;
    const AngularResponse thin = AngularSolver(sample, {.resolution = finest}).respond(wavelength_nm);
    const DiffusePassage through_thin = diffuse_passage(depth());
    constexpr double accuracy = 2e-5;  // of the resolution
    EXPECT_NEAR(thick.reflected.share, thin.reflected.share * std::pow(through_thick.share / through_thin.share, 2),
                accuracy);
    EXPECT_NEAR(thick.reflected.by_optical_depth[3],
                thick.reflected.share * 2.0 * through_thick.by_depth / through_thick.share, accuracy);
}

TEST(AngularResolutionOption, RefusesMoreAccuracyThanMeasured) {
    EXPECT_THROW((void)AngularResolution::for_accuracy(1e-5), InputError);
}

}  // namespace
}  // namespace skinfit
