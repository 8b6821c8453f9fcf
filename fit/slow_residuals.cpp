#include "fit/slow_residuals.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>

namespace skinfit {
namespace {

/// Rows: the `count` slowest cosines over `length` places, orthonormal.
Eigen::MatrixXd slow_cosines(Eigen::Index count, Eigen::Index length) {
    const auto places = static_cast<double>(length);
    return Eigen::MatrixXd::NullaryExpr(count, length, [places](Eigen::Index wave, Eigen::Index place) {
        const double norm = std::sqrt((wave == 0 ? 1.0 : 2.0) / places);
        const double middle = static_cast<double>(place) + 0.5;
        return norm * std::cos(std::numbers::pi * static_cast<double>(wave) * middle / places);
    });
}

}  // namespace

std::optional<double> slow_residuals_p_value(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& fitted) {
    const Eigen::Index most = residuals.size() / 2;
    const Eigen::MatrixXd cosines = slow_cosines(most, residuals.size());
    const Eigen::VectorXd squares = (cosines * residuals).cwiseAbs2();
    const Eigen::VectorXd taken = (cosines * fitted).rowwise().squaredNorm();
    std::optional<double> least;
    int sums = 0;
    for (Eigen::Index count = 2; count <= most; count *= 2) {
        constexpr double least_freedom = 0.5;  // chosen: below, rounding decides
        const double freedom = static_cast<double>(count) - taken.head(count).sum();
        if (freedom < least_freedom) continue;
        const boost::math::chi_squared_distribution<double> law(freedom);
        const double chance = boost::math::cdf(boost::math::complement(law, squares.head(count).sum()));
        least = std::min(least.value_or(1.0), chance);
        ++sums;
    }
    if (!least) return std::nullopt;
    return std::min(1.0, *least * sums);
}

}  // namespace skinfit
