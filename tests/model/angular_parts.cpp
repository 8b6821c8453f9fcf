#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/angular_basis.hpp"
#include "model/angular_grid.hpp"
#include "model/angular_interface.hpp"
#include "model/angular_kernels.hpp"
#include "model/fresnel.hpp"
#include "model/table.hpp"

namespace skinfit {
namespace {

// Sums of at most a few thousand terms of order one, each rounded once.
constexpr double rounding = 4096 * std::numeric_limits<double>::epsilon();

TEST(GaussLegendre, IntegratesPolynomialsExactly) {
    for (const int points : {1, 2, 5, 12, 40}) {
        const Quadrature rule = gauss_legendre(points);
        for (int degree = 0; degree < 2 * points; ++degree) {
            EXPECT_NEAR((rule.weight * rule.node.pow(degree)).sum(), 1.0 / (degree + 1), rounding);
        }
    }
}

TEST(PanelBasis, IsOrthonormal) {
    const PanelBasis basis{.edges = {0.0, 0.3, 0.8, 1.0}, .order = 4};
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(basis.size(), basis.size());
    const Quadrature rule = gauss_legendre(basis.order);
    for (std::size_t panel = 0; panel < 3; ++panel) {
        const double width = basis.edges[panel + 1] - basis.edges[panel];
        const Eigen::MatrixXd values = basis.at(basis.edges[panel] + width * rule.node).value;
        products += width * values.transpose() * scaled(rule.weight) * values;
    }
    EXPECT_LT((products - Eigen::MatrixXd::Identity(basis.size(), basis.size())).cwiseAbs().maxCoeff(), rounding);
}

TEST(PanelBasis, OneIsOneEverywhere) {
    const PanelBasis basis{.edges = {0.0, 0.3, 0.8, 1.0}, .order = 4};
    const Eigen::ArrayXd cosine{{0.0, 0.1, 0.3, 0.5, 0.8, 1.0}};
    EXPECT_LT((basis.at(cosine).value * basis.one() - Eigen::VectorXd::Ones(6)).cwiseAbs().maxCoeff(), rounding);
}

struct InterfaceCase {
    InterfaceKind kind;
    double ratio;
};

class InterfaceNodesLaw : public testing::TestWithParam<InterfaceCase> {
protected:
    static InterfaceNodes nodes(double ratio) {
        return interface_nodes({GetParam().kind, ratio, {0.0, 0.4, 1.0}, {0.0, 0.6, 1.0}},
                               {.degree = 3, .regular = 5, .crowded = 12});
    }
};

TEST_P(InterfaceNodesLaw, IntegratesPolynomialsOfPanelsExactly) {
    const InterfaceNodes sides = nodes(GetParam().ratio);
    for (int degree = 0; degree <= 3; ++degree) {
        const Eigen::ArrayXd above = (sides.cosine > 0.4).cast<double>();
        EXPECT_NEAR((sides.weight * above * sides.cosine.pow(degree)).sum(),
                    (1.0 - std::pow(0.4, degree + 1)) / (degree + 1), rounding);
    }
}

TEST_P(InterfaceNodesLaw, ReflectsAndRefractsLikeFresnelAndSnell) {
    if (GetParam().kind != InterfaceKind::fresnel) return;
    const InterfaceNodes sides = nodes(GetParam().ratio);
    const FresnelInterface interface(GetParam().ratio, 1.0);
    const Eigen::Index total = sides.cosine.size() - sides.transmitting;
    for (Eigen::Index i = 0; i < sides.cosine.size(); ++i) {
        const double refracted = i < total ? 0.0 : sides.refracted(i - total);
        // The square of the cosine is rounded to one epsilon; its root, as the reflectance, to the root of that.
        const double squares = rounding / std::max(refracted, std::sqrt(rounding));
        EXPECT_NEAR(interface.transmitted_cosine(sides.cosine(i)), refracted, squares);
        EXPECT_NEAR(interface.reflectance(sides.cosine(i)), sides.reflectance(i), 8.0 * squares);
    }
}

TEST_P(InterfaceNodesLaw, DerivativesMatchDifferences) {
    const double ratio = GetParam().ratio;
    if (GetParam().kind != InterfaceKind::fresnel || ratio == 1.0) return;  // at 1 the critical angle appears
    const double step = 1e-6;
    const InterfaceNodes centre = nodes(ratio);
    const auto check = [&](auto field, auto derivative) {
        const auto difference = [&](double h) {
            return Eigen::ArrayXd((nodes(ratio + h).*field - nodes(ratio - h).*field) / (2.0 * h));
        };
        const Eigen::ArrayXd near = difference(step);
        // The truncation error of a central difference is a third of its change when the step doubles.
        const Eigen::ArrayXd bound = (difference(2.0 * step) - near).abs() + rounding / step;
        EXPECT_TRUE(((near - centre.*derivative).abs() <= bound).all());
    };
    check(&InterfaceNodes::cosine, &InterfaceNodes::cosine_by_ratio);
    check(&InterfaceNodes::weight, &InterfaceNodes::weight_by_ratio);
    check(&InterfaceNodes::reflectance, &InterfaceNodes::reflectance_by_ratio);
    check(&InterfaceNodes::refracted, &InterfaceNodes::refracted_by_ratio);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, InterfaceNodesLaw,
    testing::Values(InterfaceCase{InterfaceKind::fresnel, 1.55}, InterfaceCase{InterfaceKind::fresnel, 1.38 / 1.36},
                    InterfaceCase{InterfaceKind::fresnel, 1.0}, InterfaceCase{InterfaceKind::fresnel, 1.36 / 1.38},
                    InterfaceCase{InterfaceKind::fresnel, 1.0 / 1.55}, InterfaceCase{InterfaceKind::mirror, 1.0},
                    InterfaceCase{InterfaceKind::open, 1.0}));

TEST(ForwardKernel, LosesNoRay) {
    const PanelBasis basis{.edges = {0.0, 0.3, 0.8, 1.0}, .order = 4};
    for (const Layer layer : {Layer::stratum_corneum, Layer::epidermis}) {
        for (const double wavelength_nm : {400.0, 500.0, 700.0}) {
            const Eigen::MatrixXd matrix = ForwardKernel::of(basis)->matrix(ForwardScattering(layer, wavelength_nm));
            EXPECT_LT((matrix * basis.one() - basis.one()).cwiseAbs().maxCoeff(), rounding);
        }
    }
}

TEST(ForwardDeflection, MeanCosineFromNormalIncidenceIsThatOfTheTable) {
    const PanelBasis basis{.edges = {0.0, 0.3, 0.8, 1.0}, .order = 4};
    const ForwardDeflection deflection(basis);
    const ForwardScattering scattering(Layer::epidermis, 436.0);  // measured: the law has the table's knots
    const std::vector<double>& degrees = embedded_table("forward_scattering").column("polar_angle_deg");
    double expected = 0.0;
    for (std::size_t i = 0; i + 1 < degrees.size(); ++i) {
        const double low = degrees[i] * rad_per_deg;
        const double high = degrees[i + 1] * rad_per_deg;
        const double share = scattering.share_within(high) - scattering.share_within(low);
        expected += share * (std::sin(high) - std::sin(low)) / (high - low);
    }
    // The coefficients of the cosine itself, by a rule that is exact on each panel.
    Eigen::VectorXd cosine = Eigen::VectorXd::Zero(basis.size());
    const Quadrature rule = gauss_legendre(basis.order);
    for (std::size_t panel = 0; panel < 3; ++panel) {
        const double width = basis.edges[panel + 1] - basis.edges[panel];
        const Eigen::ArrayXd x = basis.edges[panel] + width * rule.node;
        cosine += width * basis.at(x).value.transpose() * (rule.weight * x).matrix();
    }
    const double mean = deflection.segment_shares(scattering) * deflection.segment_means(1.0) * cosine;
    EXPECT_NEAR(mean, expected, rounding);

    // Between measured wavelengths the law has knots inside segments: what a segment moves about there, it moves by
    // less than its width, and the error of the mean is of second order in it.
    const ForwardScattering blended(Layer::epidermis, 490.0);
    constexpr int draws = 1'000'000;
    double blended_expected = 0.0;
    for (int i = 0; i < draws; ++i) blended_expected += std::cos(blended.polar_angle((i + 0.5) / draws)) / draws;
    const double segment = 1.25 * rad_per_deg;
    EXPECT_NEAR(deflection.segment_shares(blended) * deflection.segment_means(1.0) * cosine, blended_expected,
                segment * segment / 4);
}

TEST(RayleighCoefficients, IntegrateToOneAndDecay) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        const Eigen::ArrayXd coefficients = rayleigh_coefficients(edition, 12);
        // P_0 alone has a mean; K integrated over -1..1 is 2 c_0.
        EXPECT_NEAR(coefficients(0), 0.5, rounding);
    }
    // The phase function 3/8 (1 + cos^2) is P_0 / 2 + P_2 / 4.
    EXPECT_EQ(rayleigh_coefficients(Edition::revised, 12).size(), 2);
    // Uniform angles weighted by 1 + cos^2: the mean of cos^2 is (1/2 + 3/8) / (3/2) = 7/12, that of P_2 is 3/8.
    EXPECT_NEAR(rayleigh_coefficients(Edition::printed, 12)(1), 2.5 * 3.0 / 8.0, rounding);
}

}  // namespace
}  // namespace skinfit
