#include "fit/identifiability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "fit/inference.hpp"
#include "fit/minimum.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::vector<double> middle = {0.5, 0.5};

/// Two parameters between 0 and 1.
std::vector<FreeParameter> two_free() {
    const Bounds unit{.lower = 0.0, .upper = 1.0};
    return {{.parameter = Parameter::papillary_blood_fraction, .start = 0.5, .bounds = unit},
            {.parameter = Parameter::reticular_blood_fraction, .start = 0.5, .bounds = unit}};
}

TEST(Identifiability, OfASumNamesWhatTrades) {
    MatrixXd jacobian(2, 2);
    jacobian << 100, 100, 50, 50;
    const Identifiability found = identifiability(jacobian, two_free(), middle);
    ASSERT_EQ(found.directions.size(), 2U);
    // Along (1, 1) / sqrt(2) both rows change by sqrt(2) of their entries; a prior sigma is 1 / sqrt(12).
    EXPECT_NEAR(found.directions[0].singular_value, std::sqrt(2.0 * (1e4 + 2500.0) / 12.0), 1e-9);
    EXPECT_FALSE(found.directions[0].is_weak());
    EXPECT_NEAR(found.directions[1].singular_value, 0.0, 1e-9);
    EXPECT_TRUE(found.directions[1].is_weak());
    const std::string words = in_words(found.directions[1], found.names);
    EXPECT_NE(words.find("trades against"), std::string::npos) << words;
    EXPECT_NE(in_words(found.directions[0], found.names).find("together with"), std::string::npos);
    // Half of the prior variance of each is left: that of the difference.
    const double sum_left = 1.0 / (1.0 + 2.0 * 12500.0 / 12.0);
    for (const double shrinkage : found.shrinkage) EXPECT_NEAR(shrinkage, 1.0 - 0.5 * (1.0 + sum_left), 1e-9);
}

TEST(Identifiability, OfOneReadingLeavesOtherDirectionsUnknown) {
    const Identifiability found = identifiability((MatrixXd(1, 2) << 100, 0).finished(), two_free(), middle);
    ASSERT_EQ(found.directions.size(), 2U);
    EXPECT_EQ(found.directions[1].singular_value, 0.0);
    EXPECT_EQ(in_words(found.directions[1], found.names), "reticular_blood_fraction");
    EXPECT_NEAR(found.shrinkage[1], 0.0, 1e-12);
    EXPECT_NEAR(found.shrinkage[0], 1.0 - 1.0 / (1.0 + 1e4 / 12.0), 1e-12);
}

TEST(Identifiability, APriorCountsInsteadOfTheBounds) {
    std::vector<FreeParameter> free = two_free();
    free[0].prior = NormalPrior{.mean = 0.5, .sigma = 0.01};
    EXPECT_NEAR(prior_step(free[0], 0.3), 0.01, 1e-7);
    const Identifiability found = identifiability((MatrixXd(1, 2) << 100, 0).finished(), free, middle);
    // One prior sigma changes the reading by one sigma: half of the variance is left.
    EXPECT_NEAR(found.shrinkage[0], 0.5, 1e-5);
}

/// Of the logarithm, for a log-normal prior, and of what of it lies within the bounds.
TEST(Identifiability, APriorsDeviationIsThatOfItsScore) {
    FreeParameter free{.parameter = Parameter::bilirubin_g_per_l,
                       .start = 0.05,
                       .bounds = {.lower = 1e-7, .upper = 3.0},
                       .prior = LogNormalPrior{.median = 0.05, .sigma_log = 0.5}};
    EXPECT_NEAR(prior_sigma(free), 1.0, 1e-9);
    EXPECT_NEAR(prior_step(free, 2.0), 0.5 * 2.0, 1e-8);
    free.bounds.lower = 0.05;  // half of a normal distribution
    EXPECT_NEAR(prior_sigma(free), std::sqrt(1.0 - 2.0 / std::numbers::pi), 1e-9);
    free.prior = NormalPrior{.mean = 0.5, .sigma = 1e4};  // so wide that the bounds decide
    free.bounds = {.lower = 0.0, .upper = 1.0};
    EXPECT_NEAR(prior_step(free, 0.5), 1.0 / std::sqrt(12.0), 1e-6);
    free.prior = NormalPrior{.mean = 0.5, .sigma = 1e-9};  // so narrow that they do not
    EXPECT_NEAR(prior_step(free, 0.5), 1e-9, 1e-15);
    free.prior = NormalPrior{.mean = -10.0, .sigma = 1.0};  // an exponential decay from the lower bound
    free.bounds = {.lower = 0.0, .upper = 100.0};
    EXPECT_NEAR(prior_step(free, 0.5), 0.098, 0.001);
}

/// A large value that is known to a tenth is known, however large that tenth is beside the prior's own deviation in
/// g/L.
TEST(Identifiability, WhoDecidesIsJudgedInTheNaturalCoordinate) {
    FreeParameter free{.parameter = Parameter::bilirubin_g_per_l,
                       .start = 0.05,
                       .bounds = {.lower = 1e-7, .upper = 3.0},
                       .prior = LogNormalPrior{.median = 0.05, .sigma_log = 1.5}};
    EXPECT_FALSE(is_decided_by_prior(free, {.lower = 1.7, .upper = 2.4}));
    EXPECT_TRUE(is_decided_by_prior(free, {.lower = 0.003, .upper = 0.5}));
    EXPECT_FALSE(is_decided_by_prior(free, {.lower = 0.02, .upper = 0.12}));
    free.prior.reset();
    EXPECT_FALSE(is_decided_by_prior(free, free.bounds));
    free.prior = NormalPrior{.mean = 0.0, .sigma = 0.1};  // half of it, as of what has a physical zero
    free.bounds.lower = 0.0;
    EXPECT_TRUE(is_decided_by_prior(free, {.lower = 0.0, .upper = 0.16}));
    EXPECT_FALSE(is_decided_by_prior(free, {.lower = 0.0, .upper = 0.1}));
}

TEST(Identifiability, ShrinkageByAPosteriorIsThatOfItsVariance) {
    Configuration truth = with_free(quick_configuration(), {Parameter::offset});
    truth.noise = 0.02;  // leaves the offset a tenth of the standard deviation that its bounds do
    const Task task(truth, modelled_spectrum(truth, grid_nm(400, 700, 20)));
    const Minimum minimum{.values = starts(task.problem), .termination = {}};
    const auto left_by = [&](UncertaintyMethod method) {
        return 1.0 - infer(task.objective, minimum, method, 1).identifiability.shrinkage.front();
    };
    const double left = left_by(UncertaintyMethod::covariance);
    // To five standard errors of a variance from 1000 effective draws, and to what bounds differ from a normal prior.
    EXPECT_NEAR(left_by(UncertaintyMethod::posterior), left, 5.0 * std::sqrt(2.0 / 1000) * left + left * left);
}

}  // namespace
}  // namespace skinfit::test
