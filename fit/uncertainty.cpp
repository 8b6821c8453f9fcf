#include "fit/uncertainty.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace skinfit {
namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The width of the bounds in the standard deviation of a uniform distribution over them.
const double box_width = std::sqrt(12.0);

/// The problem linearised at the minimum. Each parameter is measured in standard deviations of a uniform
/// distribution over its bounds, each residual in sigmas: a singular value below one is a direction in which the data
/// say less than the bounds.
struct Linearised {
    MatrixXd jacobian;  // residuals x free parameters
    VectorXd residuals;
    VectorXd unit;  // of each parameter: width of its bounds / sqrt(12)
};

Linearised linearise(const Objective& objective, const Minimum& minimum) {
    const FitProblem& problem = objective.problem();
    const Objective::Modelled modelled = objective.model(minimum.values);
    Linearised linear{.jacobian = modelled.jacobian,
                      .residuals = objective.residuals(modelled.reading),
                      .unit = VectorXd(modelled.jacobian.cols())};
    for (Index column = 0; column < linear.unit.size(); ++column) {
        const Bounds& bounds = problem.free[static_cast<std::size_t>(column)].bounds;
        linear.unit[column] = (bounds.upper - bounds.lower) / box_width;
    }
    for (Index row = 0; row < linear.jacobian.rows(); ++row) {
        linear.jacobian.row(row) = linear.jacobian.row(row).cwiseProduct(linear.unit.transpose()) /
                                   problem.sigma[static_cast<std::size_t>(row)];
    }
    return linear;
}

/// At a bound where chi2 falls only outwards; otherwise free.
Status bound_status(const FreeParameter& free, double value, double chi2_slope) {
    const double touching = 1e-6 * (free.bounds.upper - free.bounds.lower);
    if (value - free.bounds.lower <= touching && chi2_slope >= 0.0) return Status::at_lower_bound;
    if (free.bounds.upper - value <= touching && chi2_slope <= 0.0) return Status::at_upper_bound;
    return Status::free;
}

/// Covariance of the inner parameters and the linear map from changed readings, in sigmas, to changed parameters.
struct Inverse {
    MatrixXd covariance;
    MatrixXd response;  // parameters x residuals
};

Inverse invert(const MatrixXd& jacobian) {
    const Eigen::JacobiSVD<MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
    // A direction without any effect gets a variance far beyond identifiable and cannot divide by zero.
    constexpr double least_singular_value = 1e-8;
    const VectorXd inverse = svd.singularValues().cwiseMax(least_singular_value).cwiseInverse();
    const MatrixXd scaled = svd.matrixV() * inverse.asDiagonal();
    return {.covariance = scaled * scaled.transpose(), .response = scaled * svd.matrixU().transpose()};
}

/// How far into the box chi2 rises by 2.71 (one-sided 95 %), the inner parameters following; in units of the parameter.
double distance_into_box(const Linearised& linear, Index column, const MatrixXd& inner, const Inverse& inverse) {
    constexpr double rise = 2.705543;  // square of the 95 % quantile of the normal distribution
    const VectorXd direct = linear.jacobian.col(column);
    const VectorXd left_over = inner.cols() == 0 ? direct : VectorXd(direct - inner * (inverse.response * direct));
    const double slope = std::abs(2.0 * direct.dot(linear.residuals));
    const double curvature = left_over.squaredNorm();
    // The positive root of curvature d^2 + slope d = rise, in the form that survives curvature = 0.
    const double denominator = slope + std::sqrt(slope * slope + 4.0 * curvature * rise);
    return denominator > 0.0 ? 2.0 * rise / denominator : box_width;
}

Bounds within(const Bounds& interval, const Bounds& limits) {
    return {std::max(interval.lower, limits.lower), std::min(interval.upper, limits.upper)};
}

/// The standard error of each inner parameter from the scatter of the ensemble's batches.
VectorXd monte_carlo_sigmas(const Objective& objective, const Minimum& minimum, const Inverse& inverse) {
    MatrixXd readings = objective.batch_readings(minimum.values);
    const auto batches = static_cast<double>(readings.cols());
    readings.colwise() -= VectorXd(readings.rowwise().mean());
    for (Index row = 0; row < readings.rows(); ++row) {
        readings.row(row) /= objective.problem().sigma[static_cast<std::size_t>(row)];
    }
    const MatrixXd changes = inverse.response * readings;
    return (changes.rowwise().squaredNorm() / (batches * (batches - 1.0))).cwiseSqrt();
}

}  // namespace

Uncertainty estimate_uncertainty(const Objective& objective, const Minimum& minimum) {
    const std::vector<FreeParameter>& free = objective.problem().free;
    const Linearised linear = linearise(objective, minimum);
    const auto count = static_cast<Index>(free.size());
    std::vector<Status> statuses;
    std::vector<Index> inner_columns;
    for (Index column = 0; column < count; ++column) {
        const auto i = static_cast<std::size_t>(column);
        const double slope = linear.jacobian.col(column).dot(linear.residuals);
        statuses.push_back(bound_status(free[i], minimum.values[i], slope));
        if (statuses.back() == Status::free) inner_columns.push_back(column);
    }
    const MatrixXd inner = linear.jacobian(Eigen::all, inner_columns);
    const Inverse inverse = inner_columns.empty() ? Inverse{} : invert(inner);
    const VectorXd monte_carlo = inner_columns.empty() ? VectorXd() : monte_carlo_sigmas(objective, minimum, inverse);

    Uncertainty uncertainty{.parameters = {}, .correlation = MatrixXd::Identity(count, count)};
    for (Index column = 0; column < count; ++column) {
        const auto i = static_cast<std::size_t>(column);
        const Bounds& bounds = free[i].bounds;
        const double distance =
            statuses[i] == Status::free ? box_width : distance_into_box(linear, column, inner, inverse);
        if (distance >= box_width) {
            uncertainty.parameters.push_back({.status = Status::not_identifiable,
                                              .sigma = std::nullopt,
                                              .monte_carlo_sigma = std::nullopt,
                                              .interval_95 = bounds});
            continue;
        }
        const double reach = distance * linear.unit[column];
        const double value = minimum.values[i];
        const Bounds interval = statuses[i] == Status::at_lower_bound ? Bounds{bounds.lower, value + reach}
                                                                      : Bounds{value - reach, bounds.upper};
        uncertainty.parameters.push_back({.status = statuses[i],
                                          .sigma = std::nullopt,
                                          .monte_carlo_sigma = std::nullopt,
                                          .interval_95 = within(interval, bounds)});
    }
    for (Index k = 0; k < static_cast<Index>(inner_columns.size()); ++k) {
        const auto i = static_cast<std::size_t>(inner_columns[static_cast<std::size_t>(k)]);
        const double relative_sigma = std::sqrt(inverse.covariance(k, k));
        if (relative_sigma >= 1.0) continue;
        const double unit = linear.unit[static_cast<Index>(i)];
        const double sigma = relative_sigma * unit;
        constexpr double normal_95 = 1.959964;
        uncertainty.parameters[i] = {
            .status = Status::free,
            .sigma = sigma,
            .monte_carlo_sigma = monte_carlo[k] * unit,
            .interval_95 =
                within({minimum.values[i] - normal_95 * sigma, minimum.values[i] + normal_95 * sigma}, free[i].bounds)};
    }
    for (Index a = 0; a < static_cast<Index>(inner_columns.size()); ++a) {
        for (Index b = 0; b < static_cast<Index>(inner_columns.size()); ++b) {
            uncertainty.correlation(inner_columns[static_cast<std::size_t>(a)],
                                    inner_columns[static_cast<std::size_t>(b)]) =
                inverse.covariance(a, b) / std::sqrt(inverse.covariance(a, a) * inverse.covariance(b, b));
        }
    }
    return uncertainty;
}

}  // namespace skinfit
