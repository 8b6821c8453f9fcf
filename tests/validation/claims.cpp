#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/constants.hpp"
#include "validation/angular_claims.hpp"
#include "validation/colour_claims.hpp"
#include "validation/spectral_claims.hpp"

namespace skinfit {
namespace {

constexpr ClaimVerdict reproduced = ClaimVerdict::reproduced;
constexpr ClaimVerdict not_reproduced = ClaimVerdict::not_reproduced;

/// A made-up spectrum, 400 to 700 nm in steps of 5 nm.
template <class Function>
SpectralCurve curve_of(Function value) {
    SpectralCurve curve{.name = "made up", .wavelength_nm = {}, .value = {}};
    for (int nm = 400; nm <= 700; nm += 5) {
        curve.wavelength_nm.push_back(nm);
        curve.value.push_back(value(static_cast<double>(nm)));
    }
    return curve;
}

SpectralCurve flat(double value) {
    return curve_of([value](double) { return value; });
}

/// Two dips of the given depth on a slope.
SpectralCurve w_curve(double depth, double slope_per_nm = 0.0) {
    return curve_of([=](double nm) {
        const auto dip = [nm](double centre) { return std::exp(-std::pow((nm - centre) / 6.0, 2)); };
        return 0.3 + slope_per_nm * (nm - 560.0) - depth * (dip(542) + dip(577));
    });
}

Spectrum measured_as(const SpectralCurve& curve) {
    Spectrum spectrum{};
    spectrum.wavelength_nm = curve.wavelength_nm;
    spectrum.value = curve.value;
    return spectrum;
}

TEST(SpectralCurve, IsLinearBetweenItsWavelengths) {
    const SpectralCurve curve{.name = "", .wavelength_nm = {400, 410, 430}, .value = {0.1, 0.2, 0.6}};
    EXPECT_DOUBLE_EQ(curve.at(400), 0.1);
    EXPECT_DOUBLE_EQ(curve.at(405), 0.15);
    EXPECT_DOUBLE_EQ(curve.at(410), 0.2);
    EXPECT_DOUBLE_EQ(curve.at(425), 0.5);
    EXPECT_DOUBLE_EQ(curve.at(430), 0.6);
}

TEST(DarkerInOrder, NeedsEveryStepAtEveryWavelength) {
    EXPECT_EQ(darker_in_order(std::vector{flat(0.3), flat(0.2), flat(0.1)}).verdict, reproduced);
    EXPECT_EQ(darker_in_order(std::vector{flat(0.3), flat(0.1), flat(0.2)}).verdict, not_reproduced);
    SpectralCurve crossing = flat(0.2);
    crossing.value[7] = 0.3001;
    const ClaimFinding finding = darker_in_order(std::vector{flat(0.3), crossing});
    EXPECT_EQ(finding.verdict, not_reproduced);
    EXPECT_NEAR(finding.number, -0.0001, 1e-15);
    EXPECT_NE(finding.why.find("435 nm"), std::string::npos) << finding.why;
}

TEST(DarkerInOrder, IsNotDecidedByDifferencesWithinTheSolversError) {
    EXPECT_EQ(darker_in_order(std::vector{flat(0.3), flat(0.3 - solver_accuracy)}).verdict, not_reproduced);
    SpectralCurve touching = flat(0.2);
    touching.value[0] = 0.3 - solver_accuracy;
    const ClaimFinding finding = darker_in_order(std::vector{flat(0.3), touching});
    EXPECT_EQ(finding.verdict, reproduced);
    EXPECT_NE(finding.why.find("1 of 61 drops"), std::string::npos) << finding.why;
}

TEST(WDeepensInOrder, NeedsGrowthAtEveryStep) {
    const SpectralCurve exact{
        .name = "", .wavelength_nm = {400, 542, 560, 577, 700}, .value = {0.3, 0.1, 0.2, 0.17, 0.3}};
    EXPECT_NEAR(w_depth(exact), 0.2 - (0.1 + 18.0 / 35.0 * 0.07), 1e-15);
    EXPECT_NEAR(w_depth(flat(0.2)), 0.0, 1e-15);
    EXPECT_EQ(w_deepens_in_order(std::vector{w_curve(-0.01), w_curve(0.0), w_curve(0.02)}).verdict, reproduced);
    EXPECT_EQ(w_deepens_in_order(std::vector{w_curve(0.01), w_curve(0.03), w_curve(0.02)}).verdict, not_reproduced);
    EXPECT_EQ(w_deepens_in_order(std::vector{w_curve(0.01), w_curve(0.01 + solver_accuracy)}).verdict, not_reproduced);
}

TEST(WDeepensInOrder, NeedsAPeakBetweenTwoDips) {
    const double steep_per_nm = 0.01;
    EXPECT_EQ(w_deepens_in_order(std::vector{w_curve(0.0, steep_per_nm), w_curve(0.02, steep_per_nm)}).verdict,
              not_reproduced);
}

TEST(WDeepensInOrder, SaysWhetherAMeasurementWouldShowIt) {
    EXPECT_NE(w_deepens_in_order(std::vector{w_curve(0), w_curve(0.02)}).why.find("plain"), std::string::npos);
    EXPECT_NE(w_deepens_in_order(std::vector{w_curve(0), w_curve(0.003)}).why.find("faint"), std::string::npos);
}

TEST(CloseToMeasured, IsTheRmseOfTheNearestCurve) {
    const Spectrum measured = measured_as(flat(0.3));
    const ClaimFinding near = close_to_measured(std::vector{flat(0.5), flat(0.31)}, measured);
    EXPECT_EQ(near.verdict, reproduced);
    EXPECT_NEAR(near.number, 0.01, 1e-15);
    const ClaimFinding far = close_to_measured(std::vector{flat(0.5), flat(0.32)}, measured);
    EXPECT_EQ(far.verdict, not_reproduced);
    EXPECT_NEAR(far.number, 0.02, 1e-15);
    EXPECT_NE(far.why.find("+0.020"), std::string::npos) << far.why;
}

TEST(CloseToMeasured, UsesOnlyWavelengthsThatTheCurveReaches) {
    Spectrum measured = measured_as(flat(0.3));
    measured.wavelength_nm.push_back(710);
    measured.value.push_back(0.9);
    EXPECT_NEAR(close_to_measured(std::vector{flat(0.3)}, measured).number, 0.0, 1e-15);
    measured.wavelength_nm = {800, 810};
    measured.value = {0.1, 0.1};
    EXPECT_EQ(close_to_measured(std::vector{flat(0.3)}, measured).verdict, ClaimVerdict::skipped);
}

TEST(MeasuredWithin, NeedsACurveOnEitherSide) {
    const std::vector curves{flat(0.4), flat(0.2)};
    EXPECT_EQ(measured_within(curves, measured_as(flat(0.3))).verdict, reproduced);
    EXPECT_EQ(measured_within(curves, measured_as(flat(0.2))).verdict, reproduced);
    EXPECT_EQ(measured_within(curves, measured_as(flat(0.5))).verdict, not_reproduced);
    const ClaimFinding slope =
        measured_within(curves, measured_as(curve_of([](double nm) { return nm / 1000.0 - 0.2; })));
    EXPECT_EQ(slope.verdict, not_reproduced);
    EXPECT_NEAR(slope.number, 41.0 / 61.0, 1e-15);  // 400 to 600 nm
}

TEST(RedderAndYellower, NeedEveryStepAndADifferenceThatIsSeen) {
    const std::vector<Lab> rising = {{50, 10, 20}, {50, 12, 20}, {50, 15, 20}};
    EXPECT_EQ(redder_in_order(rising).verdict, reproduced);
    EXPECT_NEAR(redder_in_order(rising).number, 5.0, 1e-15);
    EXPECT_EQ(yellower_in_order(rising).verdict, not_reproduced);
    const std::vector<Lab> back_and_forth = {{50, 10, 20}, {50, 17, 24}, {50, 15, 25}};
    EXPECT_EQ(redder_in_order(back_and_forth).verdict, not_reproduced);
    EXPECT_EQ(yellower_in_order(back_and_forth).verdict, reproduced);
    const std::vector<Lab> unseen = {{50, 10, 20}, {50, 10.5, 20}};
    EXPECT_EQ(redder_in_order(unseen).verdict, not_reproduced);
}

TEST(RedderAndYellower, LightnessAloneIsNoRedness) {
    const std::vector<Lab> darkening = {{60, 10, 20}, {40, 10.1, 20.1}};
    EXPECT_EQ(redder_in_order(darkening).verdict, not_reproduced);
    EXPECT_EQ(yellower_in_order(darkening).verdict, not_reproduced);
}

TEST(RenderedColour, OfAnEvenSpectrumIsGrey) {
    const RenderedColour colour = rendered(flat(0.5));
    EXPECT_NEAR(colour.lab.a, 0.0, 1e-12);
    EXPECT_NEAR(colour.lab.b, 0.0, 1e-12);
    EXPECT_TRUE(colour.is_in_gamut);
    EXPECT_EQ(colour.srgb, "#bcbcbc");  // 0.5 encoded is 0.735 of 255
}

/// Light whose BRDF is `per_sr(polar angle in degrees)` in every azimuth, 5 degree steps, one per cent of noise.
template <class Function>
AngularCurve lobe_of(double incidence_deg, Function per_sr) {
    AngularCurve curve{.name = "made up", .incidence_deg = incidence_deg, .ring = {}, .forward = {}, .backward = {}};
    for (int i = 0; i < 18; ++i) {
        const double value = per_sr(2.5 + 5.0 * i);
        curve.ring.push_back({.per_sr = value, .standard_error = 0.01 * value});
    }
    curve.forward = curve.ring;
    curve.backward = curve.ring;
    return curve;
}

AngularCurve lambertian_but(double mirror_factor) {
    AngularCurve curve = lobe_of(45.0, [](double) { return 0.1; });
    curve.forward[9].per_sr *= mirror_factor;
    return curve;
}

TEST(MeanBrdf, IsWeightedByProjectedSolidAngle) {
    const AngularCurve curve = lobe_of(0.0, [](double polar_deg) { return polar_deg < 30.0 ? 1.0 : 0.0; });
    EXPECT_NEAR(mean_brdf(curve.ring, 0, 18).per_sr, 0.25, 1e-14);  // sin^2 of 30 degrees
    EXPECT_NEAR(mean_brdf(curve.ring, 0, 6).per_sr, 1.0, 1e-14);
    EXPECT_NEAR(mean_brdf(curve.ring, 3, 4).standard_error, 0.01, 1e-15);
}

TEST(MoreDirectional, NeedsAGrowthBeyondTheNoise) {
    EXPECT_NEAR(directionality(lambertian_but(3.0)).value, 3.0, 1e-12);
    EXPECT_EQ(more_directional_in_order(std::vector{lambertian_but(1.0), lambertian_but(1.2)}).verdict, reproduced);
    EXPECT_EQ(more_directional_in_order(std::vector{lambertian_but(1.0), lambertian_but(1.05)}).verdict,
              not_reproduced);
    EXPECT_EQ(more_directional_in_order(std::vector{lambertian_but(2.0), lambertian_but(1.0)}).verdict, not_reproduced);
}

TEST(NearLambertian, SeesALobeThatTheMeanOverAzimuthHides) {
    AngularCurve curve = lobe_of(45.0, [](double) { return 0.1; });
    for (BrdfValue& value : curve.backward) value.per_sr *= 1.2;
    const ClaimFinding finding = near_lambertian(std::vector{curve});
    EXPECT_EQ(finding.verdict, not_reproduced);
    EXPECT_NEAR(finding.number, 0.2, 1e-14);
    EXPECT_NE(finding.why.find("backward"), std::string::npos) << finding.why;
}

TEST(NearLambertian, LooksAtTheConeOfSixtyDegrees) {
    EXPECT_NEAR(near_lambertian(std::vector{lobe_of(0.0, [](double) { return 0.1; })}).number, 0.0, 1e-14);
    const auto grazing = [](double polar_deg) { return polar_deg < 60.0 ? 0.1 : 0.5; };
    EXPECT_EQ(near_lambertian(std::vector{lobe_of(0.0, grazing)}).verdict, reproduced);
    const auto peaked = [](double polar_deg) { return std::cos(polar_deg * rad_per_deg); };
    EXPECT_EQ(near_lambertian(std::vector{lobe_of(0.0, peaked)}).verdict, not_reproduced);
    EXPECT_EQ(near_lambertian(std::vector{lobe_of(0.0, grazing), lobe_of(0.0, peaked)}).verdict, not_reproduced);
}

}  // namespace
}  // namespace skinfit
