#include "fit/box_misfit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Keeps directions without effect solvable: a standard deviation of a thousand widths of the box.
constexpr double least_information = 1e-6;

struct Limits {
    VectorXd lowest;
    VectorXd highest;
};

/// Whether a limit keeps an entry of `step` from moving on, given the slope of the quadratic model there.
bool is_pressed(double step, double lowest, double highest, double slope) {
    return (step <= lowest && slope >= 0.0) || (step >= highest && slope <= 0.0);
}

/// Moves the unheld entries of `step` towards the minimum of the quadratic model until one meets its limit, which is
/// returned; -1 where none does.
Index advance(const MatrixXd& curvature, const VectorXd& slope, const Limits& limits, const std::vector<Index>& moving,
              VectorXd& step) {
    const VectorXd towards = -MatrixXd(curvature(moving, moving)).ldlt().solve(VectorXd(slope(moving)));
    double share = 1.0;
    Index met = -1;
    for (std::size_t k = 0; k < moving.size(); ++k) {
        const Index i = moving[k];
        const double move = towards[static_cast<Index>(k)];
        if (move == 0.0) continue;
        const double room = ((move > 0.0 ? limits.highest[i] : limits.lowest[i]) - step[i]) / move;
        if (room < share) {
            share = std::max(room, 0.0);
            met = i;
        }
    }
    for (std::size_t k = 0; k < moving.size(); ++k) step[moving[k]] += share * towards[static_cast<Index>(k)];
    if (met >= 0) {
        const double middle = 0.5 * (limits.lowest[met] + limits.highest[met]);
        step[met] = step[met] > middle ? limits.highest[met] : limits.lowest[met];
    }
    return met;
}

/// Minimises gradient . step + step . curvature step / 2 within the limits by the primal active-set method.
VectorXd constrained_step(const MatrixXd& curvature, const VectorXd& gradient, const Limits& limits) {
    const Index size = gradient.size();
    VectorXd step = limits.lowest.cwiseMax(limits.highest.cwiseMin(0.0));
    std::vector<bool> held(static_cast<std::size_t>(size));
    const VectorXd first_slope = gradient + curvature * step;
    for (Index i = 0; i < size; ++i) {
        held[static_cast<std::size_t>(i)] = is_pressed(step[i], limits.lowest[i], limits.highest[i], first_slope[i]);
    }
    const Index most_rounds = 10 * size + 10;
    for (Index round = 0; round < most_rounds; ++round) {
        std::vector<Index> moving;
        for (Index i = 0; i < size; ++i) {
            if (!held[static_cast<std::size_t>(i)] && limits.lowest[i] < limits.highest[i]) moving.push_back(i);
        }
        const Index met = advance(curvature, gradient + curvature * step, limits, moving, step);
        if (met >= 0) {
            held[static_cast<std::size_t>(met)] = true;
            continue;
        }
        const VectorXd slope = gradient + curvature * step;
        Index released = -1;
        for (Index i = 0; i < size; ++i) {
            if (!held[static_cast<std::size_t>(i)] || limits.lowest[i] >= limits.highest[i]) continue;
            if (is_pressed(step[i], limits.lowest[i], limits.highest[i], slope[i])) continue;
            if (released < 0 || std::abs(slope[i]) > std::abs(slope[released])) released = i;
        }
        if (released < 0) break;
        held[static_cast<std::size_t>(released)] = false;
    }
    return step;
}

/// To the surface of the box from `position`.
Limits room_around(const VectorXd& position) {
    return {.lowest = -position, .highest = (1.0 - position.array()).matrix()};
}

VectorXd in_box(const VectorXd& position) {
    return position.cwiseMax(0.0).cwiseMin(1.0);
}

/// Of half the cost at `point`; without the bends where they would make a hill of it.
MatrixXd curvature_at(const BoxPoint& point) {
    MatrixXd curvature = point.misfit.jacobian.transpose() * point.misfit.jacobian;
    curvature.diagonal().array() += least_information;
    const MatrixXd bent = curvature + point.bend;
    return bent.llt().info() == Eigen::Success ? bent : curvature;
}

VectorXd slope_at(const BoxPoint& point) {
    return point.misfit.jacobian.transpose() * point.misfit.residual;
}

/// What is known of the bends once the misfit is known at both ends of a step [DENNIS81, Sec. 3].
MatrixXd learnt_bend(const BoxPoint& from, const BoxPoint& to) {
    const VectorXd step = to.position - from.position;
    const VectorXd change = slope_at(to) - slope_at(from);
    const VectorXd bent = (to.misfit.jacobian - from.misfit.jacobian).transpose() * to.misfit.residual;
    const double rise = change.dot(step);
    if (!(rise > 0.0)) return from.bend;
    const double known = step.dot(from.bend * step);
    const double size = known != 0.0 ? std::min(1.0, std::abs(step.dot(bent) / known)) : 1.0;
    const VectorXd missing = bent - size * (from.bend * step);
    return size * from.bend + (missing * change.transpose() + change * missing.transpose()) / rise -
           missing.dot(step) / (rise * rise) * change * change.transpose();
}

}  // namespace

BoxPoint point_at(const BoxMisfit& misfit, const VectorXd& position) {
    const Index size = position.size();
    BoxPoint point{.position = position, .misfit = misfit(position), .cost = 0.0, .bend = MatrixXd::Zero(size, size)};
    point.cost = point.misfit.residual.squaredNorm();
    return point;
}

BoxMisfit in_unit_box(const Objective& objective) {
    return [&objective](const VectorXd& position) {
        const std::vector<FreeParameter>& free = objective.problem().free;
        const std::vector<double> values = values_at(objective.problem(), position);
        Misfit misfit = objective.misfit(values);
        for (Index column = 0; column < position.size(); ++column) {
            const auto i = static_cast<std::size_t>(column);
            const Bounds bounds = natural_bounds(free[i]);
            const double by_position = (bounds.upper - bounds.lower) / coordinate_slope(free[i].prior, values[i]);
            misfit.jacobian.col(column) *= by_position;
            if (misfit.log_volume_slope.size() > 0) misfit.log_volume_slope[column] *= by_position;
        }
        return misfit;
    };
}

Bounds natural_bounds(const FreeParameter& free) {
    return {natural_coordinate(free.prior, free.bounds.lower), natural_coordinate(free.prior, free.bounds.upper)};
}

VectorXd box_position(const FitProblem& problem, std::span<const double> values) {
    VectorXd position(static_cast<Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const FreeParameter& free = problem.free[i];
        const Bounds bounds = natural_bounds(free);
        position[static_cast<Index>(i)] =
            (natural_coordinate(free.prior, values[i]) - bounds.lower) / (bounds.upper - bounds.lower);
    }
    return position;
}

double value_at_position(const FreeParameter& free, double position) {
    // Exactly the bound at 0 and 1, whatever the rounding.
    if (position == 0.0) return free.bounds.lower;
    if (position == 1.0) return free.bounds.upper;
    const Bounds bounds = natural_bounds(free);
    const double value = value_at_coordinate(free.prior, bounds.lower + position * (bounds.upper - bounds.lower));
    return std::clamp(value, free.bounds.lower, free.bounds.upper);
}

std::vector<double> values_at(const FitProblem& problem, const VectorXd& position) {
    std::vector<double> values;
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        values.push_back(value_at_position(problem.free[i], position[static_cast<Index>(i)]));
    }
    return values;
}

Descent descend(const BoxMisfit& misfit, const VectorXd& start, const MatrixXd& bend, std::optional<Index> held,
                double tolerance) {
    constexpr int most_evaluations = 200;
    Descent descent{.point = point_at(misfit, in_box(start)), .evaluations = 1, .converged = false};
    descent.point.bend = bend;
    double damping = 0.0;
    while (descent.evaluations < most_evaluations) {
        BoxPoint& point = descent.point;
        const MatrixXd curvature = curvature_at(point);
        const VectorXd slope = slope_at(point);
        MatrixXd damped = curvature;
        damped.diagonal() *= 1.0 + damping;
        Limits limits = room_around(point.position);
        if (held) limits.lowest[*held] = limits.highest[*held] = 0.0;
        const VectorXd step = constrained_step(damped, slope, limits);
        const double promised = -(2.0 * slope.dot(step) + step.dot(curvature * step));
        // A damped step promises little of what a full one would.
        if (promised < tolerance * (damping > 0.0 ? 1e-3 : 1.0)) {
            descent.converged = true;
            break;
        }
        BoxPoint trial = point_at(misfit, in_box(point.position + step));
        ++descent.evaluations;
        trial.bend = learnt_bend(point, trial);
        const double gained = point.cost - trial.cost;
        if (gained > 0.0) {
            damping = gained > 0.5 * promised ? (damping > 1e-3 ? damping / 10.0 : 0.0) : damping;
            point = std::move(trial);
        } else {
            damping = std::max(10.0 * damping, 1e-3);
            if (std::isfinite(trial.cost)) point.bend = trial.bend;
        }
    }
    return descent;
}

VectorXd step_along(const BoxPoint& point, Index column, double change) {
    Limits limits = room_around(point.position);
    limits.lowest[column] = limits.highest[column] = change;
    return constrained_step(curvature_at(point), slope_at(point), limits);
}

double sigma_along(const BoxPoint& point, Index column) {
    const MatrixXd curvature = curvature_at(point);
    const VectorXd slope = slope_at(point);
    std::vector<Index> others;
    for (Index i = 0; i < slope.size(); ++i) {
        if (i != column && !is_pressed(point.position[i], 0.0, 1.0, slope[i])) others.push_back(i);
    }
    double information = curvature(column, column);
    if (!others.empty()) {
        const VectorXd shared = curvature(others, column);
        information -= shared.dot(MatrixXd(curvature(others, others)).ldlt().solve(shared));
    }
    return 1.0 / std::sqrt(std::max(information, least_information));
}

}  // namespace skinfit
