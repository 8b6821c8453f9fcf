#include "fit/minimum.hpp"

#include <fmt/format.h>
#include <Eigen/Cholesky>

namespace skinfit {

using Index = Eigen::Index;

std::vector<double> starts(const FitProblem& problem) {
    std::vector<double> values;
    for (const FreeParameter& free : problem.free) values.push_back(free.start);
    return values;
}

double expected_gain(const FitProblem& problem, const Misfit& misfit, std::span<const double> values) {
    const std::vector<double> slopes = unit_box_slopes(problem, to_unit_box(problem, values));
    std::vector<Index> moving;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto column = static_cast<Index>(i);
        const double rise = misfit.jacobian.col(column).dot(misfit.residual);
        const Bounds& bounds = problem.free[i].bounds;
        const bool pressed = (values[i] <= bounds.lower && rise > 0.0) || (values[i] >= bounds.upper && rise < 0.0);
        if (!pressed) moving.push_back(column);
    }
    const Eigen::Map<const Eigen::VectorXd> slope(slopes.data(), misfit.jacobian.cols());
    const Eigen::MatrixXd by_position = misfit.jacobian * slope.asDiagonal();
    const Eigen::MatrixXd jacobian = by_position(Eigen::all, moving);
    const Eigen::VectorXd gradient = jacobian.transpose() * misfit.residual;
    const Eigen::MatrixXd damped =
        jacobian.transpose() * jacobian + Eigen::MatrixXd::Identity(gradient.size(), gradient.size());
    return gradient.dot(damped.ldlt().solve(gradient));
}

void judge(const Objective& objective, Minimum& minimum) {
    const Misfit misfit = objective.misfit(minimum.values);
    minimum.cost = misfit.cost();
    minimum.chi2 = objective.minimises_chi2() ? minimum.cost : objective.chi2(minimum.values);
    const double gain = expected_gain(objective.problem(), misfit, minimum.values);
    minimum.converged = gain < negligible_gain;
    if (!minimum.converged) {
        minimum.termination += fmt::format(", but one more step promises to lower the cost by {:.2g}", gain);
    }
}

Minimum concluded(const Objective& objective, std::span<const double> positions, int evaluations,
                  const std::string& termination) {
    Minimum minimum{.values = from_unit_box(objective.problem(), positions),
                    .evaluations = evaluations,
                    .termination = termination};
    judge(objective, minimum);
    return minimum;
}

Minimum minimise(const Objective& objective, Solver solver, std::span<const double> start,
                 std::optional<int> most_evaluations) {
    return solver == Solver::ceres ? minimise_by_ceres(objective, start)
                                   : minimise_by_nlopt(objective, solver, start, most_evaluations);
}

}  // namespace skinfit
