#include "model/scattering.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "model/table.hpp"

namespace skinfit {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

using Density = std::function<double(double)>;

/// Simpson's rule with `intervals` intervals.
double integral(const Density& density, double from, double to, int intervals) {
    const double step = (to - from) / intervals;
    double sum = density(from) + density(to);
    for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * density(from + i * step);
    return sum * step / 3.0;
}

/// Holds `share_below` against the integral of an unnormalised `density` of the cosine over [from, 1]; the bound is
/// the change of the integral when its intervals are doubled (16 times the error of the finer) and its roundings.
void expect_integral(const std::function<double(double)>& share_below, const Density& density, double from) {
    constexpr int intervals = 2000;
    const double whole = integral(density, from, 1.0, intervals);
    const double whole_error = 2.0 * std::abs(whole - integral(density, from, 1.0, intervals / 2));
    for (int i = 0; i <= 20; ++i) {
        const double cosine = from + (1.0 - from) * i / 20;
        const double part = integral(density, from, cosine, intervals);
        const double coarse = integral(density, from, cosine, intervals / 2);
        const double bound = (2.0 * std::abs(part - coarse) + whole_error + intervals * epsilon * whole) / whole;
        EXPECT_NEAR(share_below(cosine), part / whole, bound) << cosine;
    }
}

/// The share within the table's angle number `row`, from the columns themselves.
double measured_share(const char* column, std::size_t row) {
    return embedded_table("forward_scattering").column(column)[row] / 100.0;
}

TEST(ForwardScattering, LawIsTheTableAtItsWavelengthsAndConstantOutside) {
    struct Case {
        Layer layer;
        double wavelength_nm;
        const char* column;
    };
    const std::vector<double>& angles_deg = embedded_table("forward_scattering").column("polar_angle_deg");
    for (const Case& c :
         {Case{Layer::stratum_corneum, 436, "stratum_corneum_436_nm"},
          Case{Layer::stratum_corneum, 250, "stratum_corneum_254_nm"},
          Case{Layer::stratum_corneum, 800, "stratum_corneum_546_nm"}, Case{Layer::epidermis, 365, "epidermis_365_nm"},
          Case{Layer::epidermis, 250, "epidermis_302_nm"}, Case{Layer::epidermis, 546, "epidermis_546_nm"},
          Case{Layer::epidermis, 800, "epidermis_546_nm"}}) {
        const ForwardScattering scattering(c.layer, c.wavelength_nm);
        for (std::size_t row = 0; row < angles_deg.size(); ++row) {
            const double share = measured_share(c.column, row);
            EXPECT_NEAR(scattering.share_within(angles_deg[row] * rad_per_deg), share, 4 * epsilon) << c.column;
            if (share < 1.0) {
                EXPECT_NEAR(scattering.polar_angle(share), angles_deg[row] * rad_per_deg, 8 * epsilon) << c.column;
            }
            if (row == 0) continue;
            const double middle = 0.5 * (angles_deg[row - 1] + angles_deg[row]) * rad_per_deg;
            EXPECT_NEAR(scattering.share_within(middle), 0.5 * (share + measured_share(c.column, row - 1)),
                        8 * epsilon);
        }
    }
}

TEST(ForwardScattering, AnglesAreBlendedLinearlyBetweenWavelengths) {
    const ForwardScattering lower(Layer::epidermis, 436);
    const ForwardScattering upper(Layer::epidermis, 546);
    const ForwardScattering between(Layer::epidermis, 458);  // a fifth of the way
    const ForwardScattering ultraviolet(Layer::stratum_corneum, 254);
    const ForwardScattering next(Layer::stratum_corneum, 302);
    const ForwardScattering half_way(Layer::stratum_corneum, 278);
    for (int i = 0; i < 1000; ++i) {
        const double xi = (i + 0.5) / 1000;
        EXPECT_NEAR(between.polar_angle(xi), 0.8 * lower.polar_angle(xi) + 0.2 * upper.polar_angle(xi), 32 * epsilon);
        EXPECT_NEAR(half_way.polar_angle(xi), 0.5 * (ultraviolet.polar_angle(xi) + next.polar_angle(xi)), 32 * epsilon);
    }
}

TEST(ForwardScattering, SamplerInvertsTheLaw) {
    for (const double wavelength_nm : {300.0, 400.0, 546.0}) {
        for (const Layer layer : {Layer::stratum_corneum, Layer::epidermis}) {
            const ForwardScattering scattering(layer, wavelength_nm);
            for (int i = 0; i < 10'000; ++i) {
                const double xi = (i + 0.5) / 10'000;
                EXPECT_NEAR(scattering.share_within(scattering.polar_angle(xi)), xi, 8 * epsilon);
            }
        }
    }
}

TEST(DiffuseScattering, LawIsTheIntegralOfItsDensity) {
    // [KA04, Eq. 4]: power per solid angle proportional to the cosine.
    expect_integral(
        DiffuseScattering::share_below, [](double c) { return c; }, 0.0);
}

TEST(RayleighScattering, LawIsTheIntegralOfItsDensity) {
    const RayleighScattering revised(Edition::revised);
    expect_integral([&](double c) { return revised.share_below(c); }, [](double c) { return 1.0 + c * c; }, -1.0);
    // Printed: density 1 + cos^2 in the angle itself; by symmetry of the angle about pi/2, share within = 1 - below.
    const RayleighScattering printed(Edition::printed);
    const auto in_angle = [](double angle) { return 1.0 + std::cos(angle) * std::cos(angle); };
    const double whole = integral(in_angle, 0.0, pi, 2000);
    for (int i = 0; i <= 20; ++i) {
        const double angle = pi * i / 20;
        const double within = integral(in_angle, 0.0, angle, 2000) / whole;
        // Simpson: fourth derivative of cos^2 is at most 8, so below pi * 8 * (pi/2000)^4 / 180; acos costs
        // sqrt(epsilon) at most at the ends, where the density is smooth.
        const double truncation = pi * 8 * std::pow(pi / 2000, 4) / 180;
        EXPECT_NEAR(printed.share_below(std::cos(angle)), 1.0 - within, truncation + 2000 * epsilon) << i;
    }
}

TEST(FoldWarp, LawIsTheIntegralOfItsDensity) {
    for (const double sigma : {0.25, 0.75, 1.0}) {
        SCOPED_TRACE(sigma);
        const double b = sigma * sigma - 1.0;
        // Trowbridge-Reitz facets weighted by their projected area.
        const FoldWarp revised(Edition::revised, sigma);
        expect_integral([&](double c) { return revised.share_below(c); },
                        [b](double c) { return c / std::pow(1.0 + b * c * c, 2); }, 0.0);
        // The derivative of xi(cosine) as [KA04, Eq. 1] has it.
        const FoldWarp printed(Edition::printed, sigma);
        expect_integral([&](double c) { return printed.share_below(c); },
                        [b](double c) { return c / std::pow(1.0 + b * c * c, 3); }, 0.0);
    }
}

TEST(FoldWarp, SamplersFollowThePrintedFormulas) {
    for (int i = 1; i < 100; ++i) {
        const double xi = 0.01 * i;
        const double s2 = 0.75 * 0.75;
        const double printed = std::sqrt((s2 / std::sqrt(s2 * s2 - s2 * s2 * xi + xi) - 1.0) * (1.0 / (s2 - 1.0)));
        // s2 / root - 1 cancels near xi = 0, where it is at least xi / 2: its rounding is 8 epsilon / xi.
        EXPECT_NEAR(FoldWarp(Edition::printed, 0.75).cosine(xi), printed, 8 * epsilon / xi);
        EXPECT_DOUBLE_EQ(FoldWarp(Edition::printed, 1.0).cosine(xi), std::sqrt(xi));
        EXPECT_DOUBLE_EQ(FoldWarp(Edition::revised, 0.75).cosine(xi), std::sqrt((1 - xi) / (1 + (s2 - 1) * xi)));
        EXPECT_DOUBLE_EQ(FoldWarp(Edition::revised, 1.0).cosine(xi), std::sqrt(1 - xi));
    }
}

TEST(FoldWarp, FlatFoldsReflectLikeAMirror) {
    // 1 - share(cosine) is about sigma^2 / (1 - cosine^2) for small sigma.
    const double sigma = 1e-3;
    EXPECT_LT(FoldWarp(Edition::revised, sigma).share_below(0.99), sigma * sigma * 0.99 / (1 - 0.99 * 0.99));
    EXPECT_LT(FoldWarp(Edition::printed, sigma).share_below(0.99), sigma * sigma * 0.99 / (1 - 0.99 * 0.99));
}

TEST(RayleighDepth, AgreesWithHandArithmetic) {
    // [KA04, Eq. 3] with N put in: 32 pi^4 r^3 (ratio^2 - 1)^2 t / (9 * 0.21 lambda^4), lengths in cm.
    const double contrast = (1.5 / 1.36) * (1.5 / 1.36) - 1.0;
    const double expected =
        32 * pi * pi * pi * pi * 2.5e-6 * 2.5e-6 * 2.5e-6 * contrast * contrast * 0.02 / (1.89 * 6.25e-18);
    const double depth = rayleigh_optical_depth({.wavelength_nm = 500,
                                                 .fibre_refractive_index = 1.5,
                                                 .medium_refractive_index = 1.36,
                                                 .fibril_radius_nm = 25,
                                                 .thickness_cm = 0.02});
    EXPECT_NEAR(depth, expected, 32 * epsilon * expected);  // some 30 roundings on both sides
    EXPECT_NEAR(depth, 3.864, 0.001);
}

TEST(RayleighDepth, ScalesAsItShould) {
    const RayleighLayer layer{.wavelength_nm = 450,
                              .fibre_refractive_index = 1.5,
                              .medium_refractive_index = 1.38,
                              .fibril_radius_nm = 20,
                              .thickness_cm = 0.1};
    const double depth = rayleigh_optical_depth(layer);
    RayleighLayer changed = layer;
    changed.wavelength_nm *= 2;
    EXPECT_DOUBLE_EQ(rayleigh_optical_depth(changed), depth / 16);
    changed = layer;
    changed.fibril_radius_nm *= 2;
    EXPECT_DOUBLE_EQ(rayleigh_optical_depth(changed), depth * 8);
    changed = layer;
    changed.thickness_cm *= 3;
    EXPECT_DOUBLE_EQ(rayleigh_optical_depth(changed), depth * 3);
    changed = layer;
    changed.fibre_refractive_index = changed.medium_refractive_index;
    EXPECT_EQ(rayleigh_optical_depth(changed), 0.0);
}

}  // namespace
}  // namespace skinfit
