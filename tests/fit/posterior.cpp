#include "fit/posterior.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <utility>

#include "fit/chain_statistics.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How far the mean of draws (draws x chains) is from `expected`, in its standard errors.
double z_of_mean(const MatrixXd& draws, double expected) {
    const double mean = draws.mean();
    const double variance = (draws.array() - mean).square().sum() / static_cast<double>(draws.size() - 1);
    return (mean - expected) / std::sqrt(variance / mean_effective_size(draws));
}

/// Draws of four chains: one matrix (draws x chains) per dimension.
std::vector<MatrixXd> chains_of(const DensityFunction& density, Index dimensions, int count) {
    constexpr int chains = 4;
    std::vector<MatrixXd> draws(static_cast<std::size_t>(dimensions), MatrixXd(count, chains));
    for (int k = 0; k < chains; ++k) {
        const VectorXd start = VectorXd::Constant(dimensions, 0.5 * k - 1.0);
        NutsChain chain(density, start, MatrixXd::Identity(dimensions, dimensions),
                        ChainRandom(5, static_cast<std::uint64_t>(k)));
        chain.warm_up(400);
        const MatrixXd positions = chain.draw(count);
        EXPECT_EQ(chain.divergences(), 0);
        for (Index i = 0; i < dimensions; ++i) draws[static_cast<std::size_t>(i)].col(k) = positions.row(i).transpose();
    }
    return draws;
}

TEST(Nuts, HasTheMomentsOfACorrelatedNormalDistribution) {
    constexpr Index size = 4;
    MatrixXd root(size, size);
    root << 1, 0, 0, 0, 0.9, 0.1, 0, 0, 5, 0, 10, 0, 0.01, -0.01, 0, 0.02;
    const MatrixXd covariance = root * root.transpose();
    const MatrixXd precision = covariance.inverse();
    const VectorXd mean = VectorXd::LinSpaced(size, -1.0, 2.0);
    const DensityFunction density = [&](const VectorXd& x) {
        const VectorXd slope = precision * (x - mean);
        return LogDensity{.value = -0.5 * slope.dot(x - mean), .gradient = -slope};
    };
    const std::vector<MatrixXd> draws = chains_of(density, size, 2000);
    std::vector<double> z;
    for (std::size_t i = 0; i < size; ++i) {
        const auto row = static_cast<Index>(i);
        z.push_back(z_of_mean(draws[i], mean[row]));
        for (std::size_t j = 0; j <= i; ++j) {
            const auto column = static_cast<Index>(j);
            const MatrixXd product = (draws[i].array() - mean[row]) * (draws[j].array() - mean[column]);
            z.push_back(z_of_mean(product, covariance(row, column)));
        }
    }
    EXPECT_GT(family_wise_p_value(z), passing_p_value);
    // A tenth of a sigma beside the mean is noticed, as is a variance a fifth too large.
    EXPECT_LT(two_sided_p_value(z_of_mean(draws[0], mean[0] + 0.1 * std::sqrt(covariance(0, 0)))), passing_p_value);
    const MatrixXd squared = (draws[0].array() - mean[0]).square().matrix();
    EXPECT_LT(two_sided_p_value(z_of_mean(squared, 1.2 * covariance(0, 0))), passing_p_value);
}

TEST(Nuts, HasTheMomentsOfABanana) {
    // x standard normal, y normal around (x^2 - 1) / 2 with variance 1.
    const DensityFunction density = [](const VectorXd& position) {
        const double x = position[0];
        const double off = position[1] - 0.5 * (x * x - 1.0);
        return LogDensity{.value = -0.5 * (x * x + off * off),
                          .gradient = (VectorXd(2) << -x + x * off, -off).finished()};
    };
    const std::vector<MatrixXd> draws = chains_of(density, 2, 5000);
    const MatrixXd& x = draws[0];
    const MatrixXd& y = draws[1];
    const std::vector<double> z = {z_of_mean(x, 0.0), z_of_mean(y, 0.0), z_of_mean(x.cwiseAbs2(), 1.0),
                                   z_of_mean(y.cwiseAbs2(), 1.0 + 2.0 * 0.25),
                                   z_of_mean(x.cwiseAbs2().cwiseProduct(y), 1.0)};
    EXPECT_GT(family_wise_p_value(z), passing_p_value);
}

/// One position measured with `sigma` to lie at `centre`.
BoxMisfit measured_once(double centre, double sigma) {
    return [centre, sigma](const VectorXd& position) {
        return Misfit{.residual = (position.array() - centre).matrix() / sigma,
                      .jacobian = MatrixXd::Constant(1, 1, 1.0 / sigma)};
    };
}

double density(double x) {
    return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

double share_below(double x) {
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// Mean and mean square of a normal variable known to lie from 0 to 1.
struct Truncated {
    double mean;
    double mean_square;
};

Truncated truncated_normal(double centre, double sigma) {
    const double a = -centre / sigma;
    const double b = (1.0 - centre) / sigma;
    const double whole = share_below(b) - share_below(a);
    const double shift = (density(a) - density(b)) / whole;
    const double mean = centre + sigma * shift;
    const double variance = sigma * sigma * (1.0 + (a * density(a) - b * density(b)) / whole - shift * shift);
    return {.mean = mean, .mean_square = variance + mean * mean};
}

MatrixXd by_chain(const Posterior& posterior, Index parameter) {
    const Index draws = posterior.draws.cols() / posterior.chains;
    return posterior.draws.row(parameter).reshaped(draws, posterior.chains);
}

TEST(Posterior, IsATruncatedNormalDistributionInsideAtAndBeyondBounds) {
    std::vector<double> z;
    for (const double sigma : {0.01, 0.1, 1.0}) {
        for (const double centre : {0.5, 0.0, 1.0, -2.0 * sigma, 1.0 + sigma}) {
            const VectorXd minimum = VectorXd::Constant(1, std::clamp(centre, 0.0, 1.0));
            const Posterior posterior =
                sample_posterior(measured_once(centre, sigma), minimum, {.effective_samples = 4000});
            const Truncated expected = truncated_normal(centre, sigma);
            const MatrixXd draws = by_chain(posterior, 0);
            EXPECT_EQ(posterior.divergences, 0) << centre << " " << sigma;
            EXPECT_LT(posterior.marginals[0].r_hat, 1.01) << centre << " " << sigma;
            z.push_back(z_of_mean(draws, expected.mean));
            z.push_back(z_of_mean(draws.cwiseAbs2(), expected.mean_square));
            // A fifth of a standard deviation is noticed.
            const double fifth = 0.2 * std::sqrt(expected.mean_square - expected.mean * expected.mean);
            EXPECT_LT(two_sided_p_value(z_of_mean(draws, expected.mean + fifth)), passing_p_value);
        }
    }
    EXPECT_GT(family_wise_p_value(z), passing_p_value);
}

TEST(Posterior, SaysWhatItsDrawsSay) {
    const Posterior posterior = sample_posterior(measured_once(0.0, 0.1), VectorXd::Zero(1), {});
    const Marginal& found = posterior.marginals[0];
    EXPECT_GE(found.bulk_effective_size, 1000);
    EXPECT_GE(found.tail_effective_size, 1000);
    // Half-normal; quantiles to five of their standard errors, at 1000 effective draws.
    const double error = 5.0 * std::sqrt(0.5 * 0.5 / 1000);
    EXPECT_NEAR(share_below(found.median / 0.1) * 2.0 - 1.0, 0.5, error);
    EXPECT_NEAR(share_below(found.upper / 0.1) * 2.0 - 1.0, 0.975, error);
    EXPECT_NEAR(share_below(found.lower / 0.1) * 2.0 - 1.0, 0.025, error);
    const auto all = static_cast<double>(posterior.draws.cols());
    for (const auto& [value, share] :
         {std::pair(found.lower, 0.025), std::pair(found.median, 0.5), std::pair(found.upper, 0.975)}) {
        EXPECT_NEAR(static_cast<double>((posterior.draws.array() < value).count()) / all, share, 1.0 / all);
    }
}

TEST(Posterior, HasTheSameBitsOnAnyNumberOfThreads) {
    const auto sample = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return sample_posterior(measured_once(0.2, 0.1), VectorXd::Constant(1, 0.2), {.seed = 9}).draws;
    };
    const MatrixXd one = sample(1);
    EXPECT_EQ(one, sample(2));
    const Posterior other = sample_posterior(measured_once(0.2, 0.1), VectorXd::Constant(1, 0.2), {.seed = 10});
    EXPECT_NE(one(0, 0), other.draws(0, 0));
}

}  // namespace
}  // namespace skinfit::test
