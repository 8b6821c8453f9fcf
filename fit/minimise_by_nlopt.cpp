#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "fit/minimum.hpp"

namespace skinfit {
namespace {

/// What the objective needs behind NLopt's plain function pointer.
struct Counter {
    const Objective* objective;
    int most_evaluations;  ///< of all methods together
    int evaluations = 0;
};

double cost_at(const std::vector<double>& positions, std::vector<double>& gradient, void* data) {
    // Where a prior has no density; a quadratic model cannot hold an infinity.
    constexpr double forbidding = 1e9;
    auto* const counter = static_cast<Counter*>(data);
    ++counter->evaluations;
    const FitProblem& problem = counter->objective->problem();
    const std::vector<double> values = from_unit_box(problem, positions);
    if (gradient.empty()) {
        const double cost = counter->objective->cost(values);
        return std::isfinite(cost) ? cost : forbidding;
    }
    const Misfit misfit = counter->objective->misfit(values);
    if (!misfit.residual.allFinite()) {
        std::ranges::fill(gradient, 0.0);
        return forbidding;
    }
    const std::vector<double> slopes = unit_box_slopes(problem, positions);
    const Eigen::VectorXd by_value = 2.0 * misfit.jacobian.transpose() * misfit.residual;
    std::ranges::transform(by_value, slopes, gradient.begin(), std::multiplies<>());
    return misfit.cost();
}

std::string words(nlopt::result result) {
    switch (result) {
        case nlopt::SUCCESS:
            return "success";
        case nlopt::STOPVAL_REACHED:
            return "stop value reached";
        case nlopt::FTOL_REACHED:
            return "cost no longer falls";
        case nlopt::XTOL_REACHED:
            return "steps below the tolerance";
        case nlopt::MAXEVAL_REACHED:
            return out_of_evaluations;
        case nlopt::MAXTIME_REACHED:
            return "out of time";
        default:
            return "stopped with an error";
    }
}

/// When a method stops, in steps of the unit box and in changes of the cost.
struct Stopping {
    double step;
    double relative_change;
    int evaluations_per_parameter;
};

/// Runs one method from `positions`, which it moves; returns why it stopped.
std::string run(nlopt::algorithm algorithm, const Stopping& stopping, Counter& counter,
                std::vector<double>& positions) {
    const auto count = static_cast<unsigned>(positions.size());
    nlopt::opt solver(algorithm, count);
    solver.set_min_objective(cost_at, &counter);
    solver.set_lower_bounds(0.0);
    solver.set_upper_bounds(1.0);
    solver.set_initial_step(0.05);
    solver.set_xtol_abs(stopping.step);
    solver.set_ftol_rel(stopping.relative_change);
    const int left = counter.most_evaluations - counter.evaluations;
    if (left <= 0) return out_of_evaluations;
    solver.set_maxeval(std::min(stopping.evaluations_per_parameter * static_cast<int>(count), left));
    double cost = 0.0;
    try {
        return words(solver.optimize(positions, cost));
    } catch (const nlopt::roundoff_limited&) {
        return "steps at the limit of rounding";
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

std::string run_bobyqa(Counter& counter, std::vector<double>& positions) {
    // BOBYQA interpolates at 2 n + 1 points and refuses a single parameter; COBYLA serves there.
    return run(positions.size() > 1 ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA,
               {.step = 1e-7, .relative_change = 1e-10, .evaluations_per_parameter = 200}, counter, positions);
}

}  // namespace

Minimum minimise_by_nlopt(const Objective& objective, Solver solver, std::span<const double> start,
                          std::optional<int> most_evaluations) {
    std::vector<double> positions = to_unit_box(objective.problem(), start);
    const bool has_derivatives = solver == Solver::slsqp;
    constexpr int unlimited = std::numeric_limits<int>::max();
    Counter counter{&objective, has_derivatives ? unlimited : most_evaluations.value_or(unlimited)};
    std::string termination;
    if (solver == Solver::sbplx) {
        termination = run(nlopt::LN_SBPLX, {.step = 1e-6, .relative_change = 1e-9, .evaluations_per_parameter = 600},
                          counter, positions);
    } else if (solver == Solver::slsqp) {
        termination = run(nlopt::LD_SLSQP, {.step = 1e-9, .relative_change = 1e-12, .evaluations_per_parameter = 40},
                          counter, positions);
    } else {
        if (solver == Solver::crs2) {
            nlopt::srand(static_cast<unsigned long>(objective.problem().seed));
            (void)run(nlopt::GN_CRS2_LM, {.step = 1e-3, .relative_change = 1e-2, .evaluations_per_parameter = 150},
                      counter, positions);
        }
        termination = run_bobyqa(counter, positions);
    }
    return concluded(objective, positions, counter.evaluations, termination);
}

}  // namespace skinfit
