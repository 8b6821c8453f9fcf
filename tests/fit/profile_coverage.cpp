#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fit/profile.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How often the interval of the first of two parameters, measured together by three readings, covers its true value.
Count coverage(const VectorXd& truth, std::uint64_t seed) {
    constexpr std::uint64_t trials = 4000;
    MatrixXd jacobian(3, 2);
    jacobian << 20, 5, 10, 15, -5, 15;
    const std::vector<double> noise = normal_numbers(seed, 3 * trials);
    Count covered{.count = 0, .trials = trials};
    for (std::size_t k = 0; k < trials; ++k) {
        const VectorXd measured = jacobian * truth + Eigen::Map<const VectorXd>(noise.data() + 3 * k, 3);
        const BoxMisfit misfit = [&](const VectorXd& position) {
            return Misfit{.residual = jacobian * position - measured, .jacobian = jacobian};
        };
        const ProfileInterval found = profile_intervals(misfit, truth).intervals.front();
        if (found.lower <= truth[0] && truth[0] <= found.upper) ++covered.count;
    }
    return covered;
}

TEST(ProfileCoverage, Is95PercentAtAnyDistanceFromTheBound) {
    // Sigma is 0.044; a fixed rise of 3.84 would cover 97.5 % within one sigma of the bound.
    std::vector<double> z;
    for (const double truth : {0.0, 0.01, 0.03, 0.06, 0.1, 0.5, 0.98, 1.0}) {
        const Estimate covered = [&] {
            const Count count = coverage((VectorXd(2) << truth, 0.5).finished(), 30);
            return share_of(count.count, count.trials);
        }();
        z.push_back((covered.value - 0.95) / covered.standard_error);
        // One percent more or less is noticed together.
    }
    EXPECT_GT(family_wise_p_value(z), passing_p_value);
    const Estimate wide = share_of(3900, 4000);
    EXPECT_LT(two_sided_p_value((wide.value - 0.95) / wide.standard_error), passing_p_value);
}

}  // namespace
}  // namespace skinfit::test
