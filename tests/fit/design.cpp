#include "fit/design.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/input_error.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Smooth curves, as the derivatives of spectra are.
MatrixXd example_jacobian(Index rows) {
    MatrixXd jacobian(rows, 3);
    for (Index row = 0; row < rows; ++row) {
        const double x = static_cast<double>(row) / static_cast<double>(rows - 1);
        jacobian.row(row) << 40.0 * std::exp(-3.0 * x), 30.0 * std::sin(5.0 * x), 10.0 * std::cos(9.0 * x + 0.3);
    }
    return jacobian;
}

/// The least variance of any choice of `count` rows.
double exhaustive(const MatrixXd& jacobian, const VectorXd& prior, std::size_t count, Index column,
                  std::vector<Index> chosen = {}) {
    if (chosen.size() == count) return variance_of(jacobian, prior, chosen, column);
    double least = std::numeric_limits<double>::infinity();
    for (Index row = chosen.empty() ? 0 : chosen.back() + 1; row < jacobian.rows(); ++row) {
        std::vector<Index> more = chosen;
        more.push_back(row);
        least = std::min(least, exhaustive(jacobian, prior, count, column, more));
    }
    return least;
}

TEST(Design, VarianceIsTheInverseOfInformationAndPrior) {
    const MatrixXd jacobian = example_jacobian(8);
    const VectorXd prior = (VectorXd(3) << 0.1, 0.2, 0.3).finished();
    const std::vector<Index> rows = {0, 2, 3, 7};
    for (Index column = 0; column < 3; ++column) {
        const MatrixXd chosen = jacobian(rows, Eigen::all);
        MatrixXd information = chosen.transpose() * chosen;
        for (Index other = 0; other < 3; ++other) {
            if (other != column) information(other, other) += 1.0 / (prior[other] * prior[other]);
        }
        const MatrixXd inverse = information.inverse();
        // Two ways to invert a matrix of condition below 1e4, in roundings.
        EXPECT_NEAR(variance_of(jacobian, prior, rows, column) / inverse(column, column), 1.0, 1e-11);
    }
}

TEST(Design, ExchangeFindsTheBestOfAllChoices) {
    const VectorXd prior = VectorXd::Constant(3, 0.2);
    const MatrixXd jacobian = example_jacobian(14);
    for (Index column = 0; column < 3; ++column) {
        for (const std::size_t count : {1U, 2U, 3U, 4U}) {
            const std::vector<Index> found = best_rows(jacobian, prior, count, column);
            ASSERT_EQ(found.size(), count);
            EXPECT_LE(variance_of(jacobian, prior, found, column),
                      exhaustive(jacobian, prior, count, column) * (1.0 + 1e-9))
                << column << " " << count;
        }
    }
}

Configuration planned() {
    Configuration configuration = quick_configuration();
    configuration.wavelengths = "400:700:20";
    return configuration;
}

TEST(Design, LimitsScaleWithTheNoiseWhereTheOthersAreFixed) {
    Configuration configuration = planned();
    const DesignRequest request{.parameter = Parameter::bilirubin_g_per_l, .best = 3, .cache = no_cache()};
    const Design once = design(configuration, request);
    EXPECT_LT(once.others_fixed.sigma, once.others_free.sigma);
    EXPECT_GT(once.by_best->sigma, once.others_free.sigma);
    EXPECT_EQ(once.best_nm.size(), 3U);
    EXPECT_NEAR(once.others_free.limit / once.others_free.sigma, 2.4865, 1e-4);
    configuration.noise = 2.0 * default_noise;
    EXPECT_NEAR(design(configuration, request).others_fixed.sigma / once.others_fixed.sigma, 2.0, 1e-12);
}

TEST(Design, AllWavelengthsAreTheirOwnBest) {
    Configuration configuration = planned();
    configuration.wavelengths = "450:650:50";
    const Design all =
        design(configuration, {.parameter = Parameter::melanosome_fraction, .best = 5, .cache = no_cache()});
    EXPECT_EQ(all.best_nm, all.wavelength_nm);
    EXPECT_EQ(all.by_best->sigma, all.others_free.sigma);
}

TEST(Design, RefusesWhatHasNoEffectAndTooMany) {
    Configuration configuration = planned();
    configuration.wavelengths = "600:700:20";
    Configuration separated = configuration;  // from the dermis and its blood
    separated.layers = 2;
    EXPECT_THROW((void)design(separated, {.parameter = Parameter::reticular_blood_fraction, .cache = no_cache()}),
                 InputError);
    EXPECT_THROW(
        (void)design(configuration, {.parameter = Parameter::melanosome_fraction, .best = 7, .cache = no_cache()}),
        InputError);
}

}  // namespace
}  // namespace skinfit::test
