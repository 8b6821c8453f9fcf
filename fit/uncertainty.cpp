#include "fit/uncertainty.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "fit/box_misfit.hpp"
#include "fit/critical_values.hpp"
#include "fit/identifiability.hpp"

namespace skinfit {
namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The width of the bounds in the standard deviation of a uniform distribution over them.
const double box_width = std::sqrt(12.0);

/// The problem linearised at the minimum. Each natural coordinate is measured in standard deviations of a uniform
/// distribution over its bounds, each residual in sigmas: a singular value below one is a direction in which the data
/// say less than the bounds.
struct Linearised {
    MatrixXd jacobian;  // residuals x free parameters
    VectorXd residuals;
    VectorXd unit;  // of each natural coordinate: width of its bounds / sqrt(12)
};

/// One free parameter at the minimum.
struct Place {
    const FreeParameter& free;
    double value;
    double unit;

    [[nodiscard]] double slope() const { return coordinate_slope(free.prior, value); }
    /// The value whose natural coordinate lies `units` away.
    [[nodiscard]] double moved(double units) const {
        const double there = value_at_coordinate(free.prior, natural_coordinate(free.prior, value) + units * unit);
        return std::clamp(there, free.bounds.lower, free.bounds.upper);
    }
};

Linearised linearise(const Objective& objective, const Minimum& minimum) {
    const FitProblem& problem = objective.problem();
    const Misfit misfit = objective.misfit(minimum.values);
    Linearised linear{
        .jacobian = misfit.jacobian, .residuals = misfit.residual, .unit = VectorXd(misfit.jacobian.cols())};
    for (Index column = 0; column < linear.unit.size(); ++column) {
        const auto i = static_cast<std::size_t>(column);
        const Bounds bounds = natural_bounds(problem.free[i]);
        linear.unit[column] = (bounds.upper - bounds.lower) / box_width;
        linear.jacobian.col(column) *= linear.unit[column] / coordinate_slope(problem.free[i].prior, minimum.values[i]);
    }
    return linear;
}

/// At a bound where the cost falls only outwards; otherwise free.
Status bound_status(const FreeParameter& free, double value, double cost_slope) {
    const double touching = touching_share * (free.bounds.upper - free.bounds.lower);
    if (value - free.bounds.lower <= touching && cost_slope >= 0.0) return Status::at_lower_bound;
    if (free.bounds.upper - value <= touching && cost_slope <= 0.0) return Status::at_upper_bound;
    return Status::free;
}

/// Covariance of the inner parameters and the linear map from changed readings, in sigmas, to changed parameters.
struct Inverse {
    MatrixXd covariance;
    MatrixXd response;  // parameters x residuals
};

Inverse invert(const MatrixXd& jacobian) {
    if (jacobian.cols() == 0) return {.covariance = MatrixXd(0, 0), .response = MatrixXd(0, jacobian.rows())};
    const Eigen::JacobiSVD<MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
    // A direction without any effect gets a variance far beyond identifiable and cannot divide by zero.
    constexpr double least_singular_value = 1e-8;
    const VectorXd inverse = svd.singularValues().cwiseMax(least_singular_value).cwiseInverse();
    const MatrixXd scaled = svd.matrixV() * inverse.asDiagonal();
    return {.covariance = scaled * scaled.transpose(), .response = scaled * svd.matrixU().transpose()};
}

/// How far into the box the cost rises by 2.71 (one-sided 95 %), the inner parameters following; in units of the
/// parameter.
double distance_into_box(const Linearised& linear, Index column, const MatrixXd& inner, const Inverse& inverse) {
    constexpr double rise = 2.705543;  // square of the 95 % quantile of the normal distribution
    const VectorXd direct = linear.jacobian.col(column);
    const VectorXd left_over = direct - inner * (inverse.response * direct);
    const double slope = std::abs(2.0 * direct.dot(linear.residuals));
    const double curvature = left_over.squaredNorm();
    // The positive root of curvature d^2 + slope d = rise, in the form that survives curvature = 0.
    const double denominator = slope + std::sqrt(slope * slope + 4.0 * curvature * rise);
    return denominator > 0.0 ? 2.0 * rise / denominator : box_width;
}

/// The standard error of each inner parameter from the scatter of the ensemble's batches.
VectorXd monte_carlo_sigmas(const Objective& objective, const Minimum& minimum, const Inverse& inverse) {
    MatrixXd readings = objective.batch_readings(minimum.values);
    if (readings.cols() == 0) return VectorXd::Zero(inverse.response.rows());
    const auto batches = static_cast<double>(readings.cols());
    readings.colwise() -= VectorXd(readings.rowwise().mean());
    const VectorXd reading = objective.model(minimum.values).reading;
    const MatrixXd changes = inverse.response.leftCols(readings.rows()) * objective.residual_changes(reading, readings);
    return (changes.rowwise().squaredNorm() / (batches * (batches - 1.0))).cwiseSqrt();
}

/// Which parameters are pressed against a bound, and which move freely.
struct Split {
    std::vector<Status> statuses;
    std::vector<Index> inner;  // columns of the free ones
};

Split split_at_bounds(const std::vector<FreeParameter>& free, const Minimum& minimum, const Linearised& linear) {
    Split split;
    for (std::size_t i = 0; i < free.size(); ++i) {
        const auto column = static_cast<Index>(i);
        const double slope = linear.jacobian.col(column).dot(linear.residuals);
        split.statuses.push_back(bound_status(free[i], minimum.values[i], slope));
        if (split.statuses.back() == Status::free) split.inner.push_back(column);
    }
    return split;
}

ParameterUncertainty not_identifiable(const FreeParameter& free) {
    return {.status = Status::not_identifiable,
            .sigma = std::nullopt,
            .monte_carlo_sigma = std::nullopt,
            .interval_95 = free.bounds,
            .decided_by_prior = is_decided_by_prior(free, free.bounds)};
}

/// `reach`: how far from its bound the parameter may lie, in units.
ParameterUncertainty uncertainty_at_bound(Status status, const Place& place, double reach) {
    const Bounds& bounds = place.free.bounds;
    const Bounds interval = status == Status::at_lower_bound ? Bounds{bounds.lower, place.moved(reach)}
                                                             : Bounds{place.moved(-reach), bounds.upper};
    return {.status = status,
            .sigma = std::nullopt,
            .monte_carlo_sigma = std::nullopt,
            .interval_95 = interval,
            .decided_by_prior = is_decided_by_prior(place.free, interval)};
}

/// Where the cost has risen by 3.84 on the way to `bound`, else there.
double end_towards(const Place& place, double sigma, double bound) {
    const auto excess = [&](double coordinate) {
        const double at = value_at_coordinate(place.free.prior, coordinate);
        return linear_cost_rise(place.free.prior, place.value, sigma, at) - normal_95 * normal_95;
    };
    const double from = natural_coordinate(place.free.prior, place.value);
    const double to = natural_coordinate(place.free.prior, bound);
    if (!(excess(to) > 0.0)) return bound;
    constexpr int bits = 40;
    std::uintmax_t steps = 200;
    const auto [low, high] = boost::math::tools::toms748_solve(excess, std::min(from, to), std::max(from, to),
                                                               boost::math::tools::eps_tolerance<double>(bits), steps);
    return std::clamp(value_at_coordinate(place.free.prior, 0.5 * (low + high)), place.free.bounds.lower,
                      place.free.bounds.upper);
}

/// Standard deviations in units.
ParameterUncertainty inner_uncertainty(const Place& place, double sigma, double monte_carlo_sigma) {
    const double value_sigma = sigma * place.unit / place.slope();
    const Bounds& bounds = place.free.bounds;
    const Bounds interval = place.free.prior ? Bounds{end_towards(place, value_sigma, bounds.lower),
                                                      end_towards(place, value_sigma, bounds.upper)}
                                             : Bounds{place.moved(-normal_95 * sigma), place.moved(normal_95 * sigma)};
    return {.status = Status::free,
            .sigma = value_sigma,
            .monte_carlo_sigma = monte_carlo_sigma * place.unit / place.slope(),
            .interval_95 = interval,
            .decided_by_prior = is_decided_by_prior(place.free, interval)};
}

MatrixXd correlation(const MatrixXd& covariance, const std::vector<Index>& inner, Index count) {
    MatrixXd result = MatrixXd::Identity(count, count);
    const VectorXd inverse_sigma = covariance.diagonal().cwiseSqrt().cwiseInverse();
    result(inner, inner) = inverse_sigma.asDiagonal() * covariance * inverse_sigma.asDiagonal();
    return result;
}

}  // namespace

double linear_cost_rise(const std::optional<Prior>& prior, double value, double sigma, double at) {
    const double distance = at - value;
    const double whole = 1.0 / (sigma * sigma);
    if (!prior) return whole * distance * distance;
    const Residual score = prior_residual(*prior, value);
    const double information = std::max(0.0, whole - score.slope * score.slope);  // of all but the prior
    const double score_there = natural_coordinate(prior, at);
    // At the minimum the slopes of both parts of the cost cancel.
    return information * distance * distance - 2.0 * score.value * score.slope * distance + score_there * score_there -
           score.value * score.value;
}

Uncertainty estimate_uncertainty(const Objective& objective, const Minimum& minimum) {
    const std::vector<FreeParameter>& free = objective.problem().free;
    const Linearised linear = linearise(objective, minimum);
    const Split split = split_at_bounds(free, minimum, linear);
    const MatrixXd inner = linear.jacobian(Eigen::all, split.inner);
    const Inverse inverse = invert(inner);
    const VectorXd monte_carlo = monte_carlo_sigmas(objective, minimum, inverse);

    Uncertainty uncertainty{.parameters = {},
                            .correlation = correlation(inverse.covariance, split.inner, linear.jacobian.cols())};
    Index next_inner = 0;
    for (std::size_t i = 0; i < free.size(); ++i) {
        const auto column = static_cast<Index>(i);
        const Place place{.free = free[i], .value = minimum.values[i], .unit = linear.unit[column]};
        if (split.statuses[i] != Status::free) {
            const double distance = distance_into_box(linear, column, inner, inverse);
            uncertainty.parameters.push_back(distance >= box_width
                                                 ? not_identifiable(free[i])
                                                 : uncertainty_at_bound(split.statuses[i], place, distance));
            continue;
        }
        const double sigma = std::sqrt(inverse.covariance(next_inner, next_inner));
        const bool is_unknown = !free[i].prior && sigma >= 1.0;
        uncertainty.parameters.push_back(is_unknown ? not_identifiable(free[i])
                                                    : inner_uncertainty(place, sigma, monte_carlo[next_inner]));
        ++next_inner;
    }
    return uncertainty;
}

}  // namespace skinfit
