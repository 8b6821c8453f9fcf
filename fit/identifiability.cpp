#include "fit/identifiability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

double prior_sigma(const FreeParameter& free) {
    if (free.prior) return standard_deviation(*free.prior, free.bounds);
    return (free.bounds.upper - free.bounds.lower) / std::sqrt(12.0);
}

Identifiability identifiability(const MatrixXd& jacobian, const std::vector<FreeParameter>& free) {
    const auto size = static_cast<Index>(free.size());
    Identifiability result;
    MatrixXd scaled = jacobian;
    for (Index column = 0; column < size; ++column) {
        const FreeParameter& parameter = free[static_cast<std::size_t>(column)];
        scaled.col(column) *= prior_sigma(parameter);
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
    return identifiability(objective.misfit(values).jacobian.topRows(readings), problem.free);
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
