#pragma once

#include <Eigen/Dense>

#include "fit/box_misfit.hpp"
#include "fit/profile.hpp"

/// What tests of profiles have in common.
namespace skinfit::test {

inline constexpr double normal_95 = 1.959963984540054;      // 97.5 % quantile of the normal distribution
inline constexpr double one_sided_95 = 1.6448536269514722;  // 95 % quantile
inline constexpr double rounding = 1e-9;

/// A linear model with unit noise: residual = jacobian (position - centre).
inline BoxMisfit linear(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& centre) {
    return [jacobian, centre](const Eigen::VectorXd& position) {
        return Misfit{.residual = jacobian * (position - centre), .jacobian = jacobian};
    };
}

/// A linear model of two parameters, measured four times, that lie far inside their bounds.
struct LinearExample {
    Eigen::MatrixXd jacobian{{100, 20}, {30, 80}, {-10, 50}, {60, 60}};
    Eigen::VectorXd centre{{0.4, 0.6}};
    Eigen::MatrixXd covariance = (jacobian.transpose() * jacobian).inverse();
    Profile profile = profile_intervals(linear(jacobian, centre), centre);
};

}  // namespace skinfit::test
