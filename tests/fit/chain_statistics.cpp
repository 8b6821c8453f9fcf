#include "fit/chain_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd independent(std::uint64_t seed, Index draws, Index chains) {
    const std::vector<double> numbers = normal_numbers(seed, static_cast<std::size_t>(draws * chains));
    return Eigen::Map<const MatrixXd>(numbers.data(), draws, chains);
}

/// Each draw `memory` times the one before plus noise.
MatrixXd autoregressive(double memory, Index draws, Index chains) {
    MatrixXd numbers = independent(7, draws, chains);
    for (Index draw = 1; draw < draws; ++draw) {
        numbers.row(draw) = memory * numbers.row(draw - 1) + std::sqrt(1.0 - memory * memory) * numbers.row(draw);
    }
    return numbers;
}

// The effective size is itself estimated: from 20000 draws to a few percent.
constexpr double estimation = 0.15;

TEST(ChainStatistics, IndependentDrawsAreWorthThemselves) {
    const MatrixXd draws = independent(1, 5000, 4);
    EXPECT_NEAR(bulk_effective_size(draws) / 20000, 1.0, estimation);
    EXPECT_NEAR(mean_effective_size(draws) / 20000, 1.0, estimation);
    EXPECT_NEAR(tail_effective_size(draws) / 20000, 1.0, estimation);
    EXPECT_LT(r_hat(draws), 1.002);
}

TEST(ChainStatistics, MemoryCostsWhatTheoryOfAutoregressionSays) {
    for (const double memory : {0.5, 0.9, -0.4}) {
        const MatrixXd draws = autoregressive(memory, 5000, 4);
        EXPECT_NEAR(mean_effective_size(draws) / (20000 * (1.0 - memory) / (1.0 + memory)), 1.0, estimation) << memory;
    }
}

TEST(ChainStatistics, DoNotDependOnTheScale) {
    const MatrixXd draws = autoregressive(0.5, 1000, 4);
    const MatrixXd cubed = draws.array().cube().matrix();
    EXPECT_EQ(bulk_effective_size(draws), bulk_effective_size(cubed));
    EXPECT_EQ(tail_effective_size(draws), tail_effective_size(cubed));
}

TEST(ChainStatistics, RHatSeesChainsInDifferentPlacesOfDifferentWidthsAndDrifting) {
    MatrixXd elsewhere = independent(2, 500, 4);
    elsewhere.col(0).array() += 1.0;
    EXPECT_GT(r_hat(elsewhere), 1.05);
    MatrixXd wider = independent(3, 500, 4);
    wider.col(0) *= 3.0;
    EXPECT_GT(r_hat(wider), 1.05);
    MatrixXd drifting = independent(4, 500, 4);
    drifting.bottomRows(250).array() += 1.0;
    EXPECT_GT(r_hat(drifting), 1.05);
    EXPECT_LT(r_hat(independent(5, 500, 4)), 1.01);
}

TEST(ChainStatistics, QuantilesLieBetweenDraws) {
    const MatrixXd draws = MatrixXd(Eigen::VectorXd::LinSpaced(101, 0.0, 100.0));
    EXPECT_DOUBLE_EQ(quantile(draws, 0.025), 2.5);
    EXPECT_DOUBLE_EQ(quantile(draws, 0.5), 50.0);
    EXPECT_DOUBLE_EQ(quantile(draws, 1.0), 100.0);
}

}  // namespace
}  // namespace skinfit::test
