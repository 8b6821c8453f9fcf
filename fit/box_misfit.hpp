#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "fit/objective.hpp"

/// Sums of squares over the unit box: each position is where a free parameter lies between its bounds, 0 to 1, in its
/// natural coordinate. So exp(-cost / 2) over the box is the posterior's density where `Misfit::log_volume` is 0.
namespace skinfit {

/// The misfit at a position in the unit box, derivatives by position.
using BoxMisfit = std::function<Misfit(const Eigen::VectorXd& position)>;

/// `objective` over the positions of its free parameters; it must outlive the result.
[[nodiscard]] BoxMisfit in_unit_box(const Objective& objective);

/// The bounds of a free parameter in its natural coordinate.
[[nodiscard]] Bounds natural_bounds(const FreeParameter& free);

/// The value of one parameter at its position.
[[nodiscard]] double value_at_position(const FreeParameter& free, double position);

/// Values of the free parameters as positions, and back.
[[nodiscard]] Eigen::VectorXd box_position(const FitProblem& problem, std::span<const double> values);
[[nodiscard]] std::vector<double> values_at(const FitProblem& problem, const Eigen::VectorXd& position);

/// A position and the misfit there.
struct BoxPoint {
    Eigen::VectorXd position;
    Misfit misfit;
    double cost;  ///< squared norm of the residual
    /// What the bends of the model add to the curvature of half the cost: the sum of residuals times their second
    /// derivatives, as learnt on the way here; zeros where nothing has been learnt.
    Eigen::MatrixXd bend;
};

/// Where a descent ended.
struct Descent {
    BoxPoint point;
    int evaluations;
    bool converged;
};

/// The misfit at `position`, bends unknown.
[[nodiscard]] BoxPoint point_at(const BoxMisfit& misfit, const Eigen::VectorXd& position);

/// Minimises `misfit` over the unit box from `start`, one position held if asked for: damped steps to the minimum of
/// the quadratic model in the box, the exact first derivatives completed by what changes of the Jacobian tell of the
/// second ones [DENNIS81], beginning with `bend`. Converged where the model promises a decrease below `tolerance`.
[[nodiscard]] Descent descend(const BoxMisfit& misfit, const Eigen::VectorXd& start, const Eigen::MatrixXd& bend,
                              std::optional<Eigen::Index> held, double tolerance);

/// The step from `point` that minimises its quadratic model within the box, where `column` steps by `change`.
[[nodiscard]] Eigen::VectorXd step_along(const BoxPoint& point, Eigen::Index column, double change);

/// The standard deviation of position `column` in the quadratic model at `point`, all others free but those pressed
/// against their bounds; a thousand where the misfit does not depend on it.
[[nodiscard]] double sigma_along(const BoxPoint& point, Eigen::Index column);

}  // namespace skinfit
