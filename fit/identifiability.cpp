#include "fit/identifiability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "fit/box_misfit.hpp"

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The standard deviation of a standard normal variable within `range`, which need not hold its middle.
double normal_deviation_within(const Bounds& range) {
    const auto moment = [&range](int power) {
        const double nearest = std::clamp(0.0, range.lower, range.upper);  // where the density is largest
        const auto weighted = [&](double z) {
            return std::pow(z - nearest, power) * std::exp(0.5 * (nearest - z) * (nearest + z));
        };
        double sum = 0.0;
        constexpr double far = 40.0;  // beyond it the density is less than the least number
        for (const Bounds& side : {Bounds{std::max(range.lower, nearest - far), nearest},
                                   Bounds{nearest, std::min(range.upper, nearest + far)}}) {
            if (side.lower == side.upper) continue;
            sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(weighted, side.lower, side.upper);
        }
        return sum;
    };
    const double mass = moment(0);
    const double mean = moment(1) / mass;
    return std::sqrt(moment(2) / mass - mean * mean);
}

}  // namespace

double prior_sigma(const FreeParameter& free) {
    const Bounds bounds = natural_bounds(free);
    if (free.prior) return normal_deviation_within(bounds);
    return (bounds.upper - bounds.lower) / std::sqrt(12.0);
}

double prior_step(const FreeParameter& free, double value) {
    return prior_sigma(free) / coordinate_slope(free.prior, value);
}

bool is_decided_by_prior(const FreeParameter& free, const Bounds& interval_95) {
    constexpr double tail = 0.025;
    if (!free.prior) return false;
    const auto width = [&free](double lower, double upper) {
        return natural_coordinate(free.prior, upper) - natural_coordinate(free.prior, lower);
    };
    const double without_spectrum =
        width(quantile_within(*free.prior, free.bounds, tail), quantile_within(*free.prior, free.bounds, 1.0 - tail));
    return width(interval_95.lower, interval_95.upper) >= without_spectrum / std::numbers::sqrt2;
}

Identifiability identifiability(const MatrixXd& jacobian, const std::vector<FreeParameter>& free,
                                std::span<const double> values) {
    const auto size = static_cast<Index>(free.size());
    Identifiability result;
    MatrixXd scaled = jacobian;
    for (Index column = 0; column < size; ++column) {
        const auto i = static_cast<std::size_t>(column);
        const FreeParameter& parameter = free[i];
        scaled.col(column) *= prior_step(parameter, values[i]);
        result.names.push_back(name_of(parameter));
    }
    const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeFullV);
    for (Index k = 0; k < size; ++k) {
        // Fewer readings than parameters leave directions of which nothing is known.
        const double singular_value = k < svd.singularValues().size() ? svd.singularValues()[k] : 0.0;
        result.directions.push_back({.singular_value = singular_value, .components = svd.matrixV().col(k)});
    }
    const MatrixXd information = MatrixXd::Identity(size, size) + scaled.transpose() * scaled;
    const VectorXd variance = information.ldlt().solve(MatrixXd::Identity(size, size)).diagonal();
    for (const double left : variance) result.shrinkage.push_back(1.0 - left);
    return result;
}

Identifiability identifiability(const Objective& objective, std::span<const double> values) {
    const FitProblem& problem = objective.problem();
    const auto readings = static_cast<Index>(objective.reading_count());
    return identifiability(objective.misfit(values).jacobian.topRows(readings), problem.free, values);
}

std::string in_words(const Direction& direction, const std::vector<std::string>& names) {
    constexpr double notable = 0.3;  // of the largest component
    std::vector<std::size_t> order;
    const double largest = direction.components.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (std::abs(direction.components[static_cast<Index>(i)]) >= notable * largest) order.push_back(i);
    }
    const auto size = [&](std::size_t i) { return std::abs(direction.components[static_cast<Index>(i)]); };
    std::ranges::stable_sort(order, std::greater<>{}, size);
    const bool sign = direction.components[static_cast<Index>(order.front())] > 0.0;
    std::vector<std::string_view> with;
    std::vector<std::string_view> against;
    for (const std::size_t i : order) {
        const bool same = (direction.components[static_cast<Index>(i)] > 0.0) == sign;
        (same ? with : against).push_back(names[i]);
    }
    if (against.empty()) return fmt::format("{}", fmt::join(with, " together with "));
    return fmt::format("{} {} against {}", fmt::join(with, " and "), with.size() > 1 ? "trade" : "trades",
                       fmt::join(against, " and "));
}

}  // namespace skinfit
