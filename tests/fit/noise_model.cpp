#include "fit/noise_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/input_error.hpp"
#include "fit/loss.hpp"

namespace skinfit::test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

const std::vector<double> wavelength_nm = {400, 410, 425, 500, 505, 700};
const std::vector<double> sigma = {0.003, 0.004, 0.003, 0.006, 0.003, 0.01};

Eigen::MatrixXd covariance(const Discrepancy& discrepancy) {
    Eigen::MatrixXd matrix(6, 6);
    for (Eigen::Index a = 0; a < 6; ++a) {
        for (Eigen::Index b = 0; b < 6; ++b) {
            const double d =
                std::abs(wavelength_nm[static_cast<std::size_t>(a)] - wavelength_nm[static_cast<std::size_t>(b)]) /
                discrepancy.length_nm;
            const double correlation = discrepancy.kernel == Kernel::squared_exponential
                                           ? std::exp(-d * d / 2)
                                           : (1 + std::sqrt(3.0) * d) * std::exp(-std::sqrt(3.0) * d);
            matrix(a, b) = discrepancy.sigma * discrepancy.sigma * correlation +
                           (a == b ? std::pow(sigma[static_cast<std::size_t>(a)], 2) : 0.0);
        }
    }
    return matrix;
}

TEST(NoiseModel, RefusesUncertaintiesThatVanishBesideADiscrepancy) {
    std::vector<double> close_nm;
    for (int i = 0; i <= 60; ++i) close_nm.push_back(400 + 5 * i);
    const std::vector<double> tiny(close_nm.size(), 1e-12);
    const Discrepancy smooth{.sigma = 0.005, .length_nm = 30, .kernel = Kernel::squared_exponential};
    EXPECT_THROW(NoiseModel(close_nm, tiny, smooth), InputError);
    EXPECT_NO_THROW(NoiseModel(close_nm, tiny, std::nullopt));
}

TEST(NoiseModel, WhitensItsCovariance) {
    for (const Kernel kernel : {Kernel::squared_exponential, Kernel::matern_3_2}) {
        const Discrepancy discrepancy{.sigma = 0.005, .length_nm = 30, .kernel = kernel};
        const NoiseModel noise(wavelength_nm, sigma, discrepancy);
        const Eigen::MatrixXd once = noise.whiten(covariance(discrepancy));
        const Eigen::MatrixXd twice = noise.whiten(once.transpose());
        // Condition number below 1e2, in some roundings per element.
        EXPECT_LT((twice - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e4 * epsilon);
    }
}

TEST(NoiseModel, RootOfTheDepartureSquaredIsItsCovariance) {
    for (const Kernel kernel : {Kernel::squared_exponential, Kernel::matern_3_2}) {
        const Discrepancy discrepancy{.sigma = 0.005, .length_nm = 30, .kernel = kernel};
        const Eigen::MatrixXd root = departure_root(wavelength_nm, discrepancy);
        Eigen::MatrixXd expected = covariance(discrepancy);
        for (Eigen::Index i = 0; i < 6; ++i) expected(i, i) -= std::pow(sigma[static_cast<std::size_t>(i)], 2);
        // In roundings of the largest element; those of the eigenvectors add up over six of them.
        EXPECT_LT((root * root - expected).cwiseAbs().maxCoeff(), 100 * epsilon * expected.maxCoeff());
        EXPECT_LT((root - root.transpose()).cwiseAbs().maxCoeff(), 100 * epsilon * root.maxCoeff());
    }
}

TEST(NoiseModel, WithoutDiscrepancyDividesBySigma) {
    const Eigen::VectorXd whitened = NoiseModel(wavelength_nm, sigma, std::nullopt).whiten(Eigen::VectorXd::Ones(6));
    for (std::size_t i = 0; i < sigma.size(); ++i) {
        EXPECT_NEAR(whitened[static_cast<Eigen::Index>(i)] * sigma[i], 1.0, 4 * epsilon);
    }
}

TEST(NoiseModel, UnexplainedIsLessThePosteriorMeanOfTheDeparture) {
    for (const Kernel kernel : {Kernel::squared_exponential, Kernel::matern_3_2}) {
        const Discrepancy discrepancy{.sigma = 0.005, .length_nm = 30, .kernel = kernel};
        Eigen::VectorXd differences(6);
        differences << 0.004, 0.006, 0.005, -0.002, -0.003, 0.01;
        const Eigen::Map<const Eigen::VectorXd> noise(sigma.data(), 6);
        const Eigen::MatrixXd both = covariance(discrepancy);
        const Eigen::MatrixXd kernel_matrix = both - Eigen::MatrixXd(noise.cwiseAbs2().asDiagonal());
        const Eigen::VectorXd mean = kernel_matrix * both.inverse() * differences;
        const Eigen::VectorXd expected = (differences - mean).cwiseQuotient(noise);
        const Eigen::VectorXd found = NoiseModel(wavelength_nm, sigma, discrepancy).unexplained(differences);
        // Condition number below 1e2, in some roundings per element.
        EXPECT_LT((found - expected).norm(), 1e4 * epsilon * differences.cwiseQuotient(noise).norm());
    }
}

TEST(NoiseModel, WithoutDiscrepancyNothingIsExplained) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
    const NoiseModel noise(wavelength_nm, sigma, std::nullopt);
    EXPECT_EQ(noise.unexplained(ones), Eigen::VectorXd(noise.whiten(ones)));
}

TEST(NoiseModel, ASmoothDepartureIsExplainedAndARoughOneIsNot) {
    const std::vector<double> grid = [] {
        std::vector<double> nm;
        for (int i = 0; i < 61; ++i) nm.push_back(400.0 + 5.0 * i);
        return nm;
    }();
    const std::vector<double> even(grid.size(), 0.003);
    const NoiseModel noise(grid, even, Discrepancy{.sigma = 0.005, .length_nm = 30});
    Eigen::VectorXd wave(61);
    Eigen::VectorXd saw(61);
    for (Eigen::Index i = 0; i < 61; ++i) {
        wave[i] = 0.005 * std::sin(0.15 * static_cast<double>(i));  // a period of 200 nm
        saw[i] = i % 2 == 0 ? 0.003 : -0.003;
    }
    // By eigenvalues of a stationary kernel, s^2 sqrt(2 pi) l / step exp(-(k l)^2 / 2) is above 40 noise variances at
    // the wave's frequency k = 0.03 per nm, so that less than a fortieth is left but for the ends; below 1e-6 at the
    // saw's.
    EXPECT_LT(noise.unexplained(wave).norm(), 0.1 * (wave / 0.003).norm());
    EXPECT_GT(noise.unexplained(saw).norm(), 0.9 * (saw / 0.003).norm());
}

TEST(NoiseModel, ASmallDiscrepancyIsNone) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
    const Eigen::VectorXd without = NoiseModel(wavelength_nm, sigma, std::nullopt).whiten(ones);
    // A millionth of the noise changes a covariance by 1e-12 of its diagonal, times six neighbours.
    const Discrepancy small{.sigma = 3e-9, .length_nm = 30};
    EXPECT_LT((NoiseModel(wavelength_nm, sigma, small).whiten(ones) - without).norm(), 1e-11 * without.norm());
}

TEST(Loss, SquareIsItsRho) {
    constexpr double c = 1.5;
    for (const double r : {-20.0, -1.5, -0.3, 0.0, 1e-9, 1.49, 1.51, 7.0}) {
        const double huber = std::abs(r) <= c ? r * r : 2 * c * std::abs(r) - c * c;
        const double cauchy = c * c * std::log1p(r * r / (c * c));
        EXPECT_NEAR(std::pow(softened(r, Loss::huber, c).value, 2), huber, 8 * epsilon * huber);
        EXPECT_NEAR(std::pow(softened(r, Loss::cauchy, c).value, 2), cauchy, 8 * epsilon * cauchy);
        EXPECT_EQ(softened(r, Loss::squares, c).value, r);
    }
}

TEST(Loss, SlopeIsTheDerivative) {
    constexpr double c = 1.5;
    constexpr double h = 1e-5;
    for (const Loss loss : {Loss::squares, Loss::huber, Loss::cauchy}) {
        for (const double r : {-20.0, -1.0, 0.0, 1e-3, 1.4, 1.6, 7.0}) {
            const double difference = (softened(r + h, loss, c).value - softened(r - h, loss, c).value) / (2 * h);
            // Third derivatives are below 10: h^2 10/6; rounding: 20 epsilon / h.
            EXPECT_NEAR(softened(r, loss, c).slope, difference, 2 * h * h + 40 * epsilon / h) << r;
        }
    }
}

}  // namespace
}  // namespace skinfit::test
