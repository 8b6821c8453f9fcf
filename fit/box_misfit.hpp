#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "fit/objective.hpp"

/// Sums of squares over the unit box: each position is where a free parameter lies between its bounds, 0 to 1.
namespace skinfit {

/// The misfit at a position in the unit box, derivatives by position.
using BoxMisfit = std::function<Misfit(const Eigen::VectorXd& position)>;

/// `objective` over the positions of its free parameters; it must outlive the result.
[[nodiscard]] BoxMisfit in_unit_box(const Objective& objective);

/// Values of the free parameters as positions, and back.
[[nodiscard]] Eigen::VectorXd box_position(const FitProblem& problem, std::span<const double> values);
[[nodiscard]] std::vector<double> values_at(const FitProblem& problem, const Eigen::VectorXd& position);

/// A position and the misfit there.
struct BoxPoint {
    Eigen::VectorXd position;
    Misfit misfit;
    double cost;  ///< squared norm of the residual
};

/// Where a descent ended.
struct Descent {
    BoxPoint point;
    int evaluations;
    bool converged;
};

/// Minimises `misfit` over the unit box from `start`, one position held if asked for, by Levenberg's and Marquardt's
/// method on the box-constrained quadratic model. Converged where that model promises a decrease below `tolerance`.
[[nodiscard]] Descent descend(const BoxMisfit& misfit, const Eigen::VectorXd& start, std::optional<Eigen::Index> held,
                              double tolerance);

/// The step from `point` that minimises the misfit linearised there, within the box, where `column` steps by `change`.
[[nodiscard]] Eigen::VectorXd step_along(const BoxPoint& point, Eigen::Index column, double change);

/// The standard deviation of position `column` in the misfit linearised at `point`, all others free but those pressed
/// against their bounds; infinite where the misfit does not depend on it.
[[nodiscard]] double sigma_along(const BoxPoint& point, Eigen::Index column);

}  // namespace skinfit
