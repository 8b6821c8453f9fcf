#include <ceres/ceres.h>

#include <algorithm>
#include <utility>

#include "fit/minimum.hpp"
#include "fit/step_tolerance.hpp"

namespace skinfit {
namespace {

/// The objective as Ceres sees it: residuals over positions in the unit box. Ceres asks for the residuals of a trial
/// first and for the Jacobian once it is accepted; both come from one evaluation of the model.
class Residuals : public ceres::CostFunction {
public:
    Residuals(const Objective& objective, int& evaluations) : objective_(&objective), evaluations_(&evaluations) {
        set_num_residuals(static_cast<int>(objective.residual_count()));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(objective.free_count()));
    }

    bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
        const FitProblem& problem = objective_->problem();
        const std::vector<double> positions(parameters[0], parameters[0] + objective_->free_count());
        if (positions != last_positions_) {
            try {
                last_misfit_ = objective_->misfit(from_unit_box(problem, positions));
            } catch (const Cancelled&) {
                // No exception may cross Ceres. It ends where nothing is left to gain; the evaluation after that
                // throws.
                last_misfit_.residual.setZero(static_cast<Eigen::Index>(objective_->residual_count()));
                last_misfit_.jacobian.setZero(last_misfit_.residual.size(),
                                              static_cast<Eigen::Index>(objective_->free_count()));
            }
            last_positions_ = positions;
            ++*evaluations_;
        }
        // Where a prior has no density: Ceres tries a shorter step.
        if (!last_misfit_.residual.allFinite()) return false;
        const Eigen::Index rows = last_misfit_.residual.size();
        Eigen::Map<Eigen::VectorXd>(residuals, rows) = last_misfit_.residual;
        if (jacobians == nullptr || jacobians[0] == nullptr) return true;
        const std::vector<double> slopes = unit_box_slopes(problem, positions);
        const Eigen::Map<const Eigen::VectorXd> slope(slopes.data(), last_misfit_.jacobian.cols());
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            jacobians[0], rows, last_misfit_.jacobian.cols()) = last_misfit_.jacobian * slope.asDiagonal();
        return true;
    }

private:
    const Objective* objective_;
    int* evaluations_;
    mutable std::vector<double> last_positions_;
    mutable Misfit last_misfit_;
};

/// The unit box without the held positions: a step that leads out of it ends on its surface. Ceres' own bounds cost a
/// line search a step.
class UnitBox : public ceres::Manifold {
public:
    explicit UnitBox(const std::vector<bool>& held) : size_(static_cast<int>(held.size())) {
        for (int i = 0; i < size_; ++i) {
            if (!held[static_cast<std::size_t>(i)]) moving_.push_back(i);
        }
    }

    int AmbientSize() const override { return size_; }
    int TangentSize() const override { return static_cast<int>(moving_.size()); }

    bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
        std::copy_n(x, size_, x_plus_delta);
        for (std::size_t k = 0; k < moving_.size(); ++k) {
            x_plus_delta[moving_[k]] = std::clamp(x[moving_[k]] + delta[k], 0.0, 1.0);
        }
        return true;
    }

    bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
        std::fill_n(jacobian, AmbientSize() * TangentSize(), 0.0);
        for (std::size_t k = 0; k < moving_.size(); ++k) {
            jacobian[static_cast<std::size_t>(moving_[k]) * moving_.size() + k] = 1.0;
        }
        return true;
    }

    bool Minus(const double* y, const double* x, double* y_minus_x) const override {
        for (std::size_t k = 0; k < moving_.size(); ++k) y_minus_x[k] = y[moving_[k]] - x[moving_[k]];
        return true;
    }

    bool MinusJacobian(const double* /*x*/, double* jacobian) const override {
        std::fill_n(jacobian, AmbientSize() * TangentSize(), 0.0);
        for (std::size_t k = 0; k < moving_.size(); ++k) {
            jacobian[k * static_cast<std::size_t>(size_) + static_cast<std::size_t>(moving_[k])] = 1.0;
        }
        return true;
    }

private:
    int size_;
    std::vector<int> moving_;
};

bool at_bound(double position) {
    return position <= 0.0 || position >= 1.0;
}

/// Stops Ceres as soon as a position that it may change arrives at a bound: further steps would be computed as if it
/// could go on, and cut there again and again.
class StopAtBound : public ceres::IterationCallback {
public:
    explicit StopAtBound(const std::vector<double>& positions) : positions_(&positions), last_(positions) {}

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
        bool arrived = false;
        for (std::size_t i = 0; i < last_.size(); ++i) {
            arrived = arrived || (at_bound((*positions_)[i]) && !at_bound(last_[i]));
        }
        last_ = *positions_;
        return arrived ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

private:
    const std::vector<double>* positions_;
    std::vector<double> last_;
};

ceres::Solver::Options solver_options() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 400;    // curved valleys take hundreds of short steps
    options.function_tolerance = 1e-10;  // of the cost, relative
    options.gradient_tolerance = 1e-12;
    options.parameter_tolerance = step_tolerance;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;  // the ensemble spreads over threads itself
    options.update_state_every_iteration = true;
    return options;
}

/// Minimises over the positions that are not held, starting from and changing `positions`.
ceres::Solver::Summary minimise_over(const Objective& objective, const std::vector<bool>& held,
                                     std::vector<double>& positions, int& evaluations) {
    ceres::Problem problem;
    problem.AddResidualBlock(new Residuals(objective, evaluations), nullptr, positions.data());
    problem.SetManifold(positions.data(), new UnitBox(held));
    StopAtBound stop_at_bound(positions);
    ceres::Solver::Options options = solver_options();
    options.callbacks.push_back(&stop_at_bound);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary;
}

/// Which positions lie at a bound beyond which the cost would fall.
std::vector<bool> pressed_against_bounds(const Objective& objective, const std::vector<double>& positions) {
    const Misfit misfit = objective.misfit(from_unit_box(objective.problem(), positions));
    const Eigen::VectorXd slopes = misfit.jacobian.transpose() * misfit.residual;
    std::vector<bool> pressed;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double slope = slopes[static_cast<Eigen::Index>(i)];
        pressed.push_back((positions[i] <= 0.0 && slope > 0.0) || (positions[i] >= 1.0 && slope < 0.0));
    }
    return pressed;
}

}  // namespace

Minimum minimise_by_ceres(const Objective& objective, std::span<const double> start) {
    std::vector<double> positions = to_unit_box(objective.problem(), start);
    int evaluations = 0;
    std::string termination;
    // An active-set method around Ceres: what arrives at a bound is held there; once the rest has converged, what is
    // not pressed against its bound is released.
    constexpr int most_rounds = 50;
    std::vector<bool> held(positions.size(), false);
    bool settled = false;
    for (int round = 0; round < most_rounds && !settled; ++round) {
        const ceres::Solver::Summary summary = minimise_over(objective, held, positions, evaluations);
        termination = summary.message;
        if (summary.termination_type == ceres::USER_SUCCESS) {
            std::transform(positions.begin(), positions.end(), held.begin(), at_bound);
        } else if (summary.termination_type == ceres::CONVERGENCE) {
            const std::vector<bool> pressed = pressed_against_bounds(objective, positions);
            settled = pressed == held;
            held = pressed;
        } else {
            break;
        }
    }
    return concluded(objective, positions, evaluations, termination);
}

}  // namespace skinfit
