#pragma once

#include <string>
#include <vector>

#include "fit/objective.hpp"

namespace skinfit {

/// Where a solver ended.
struct Minimum {
    std::vector<double> values;  ///< of the free parameters
    double chi2 = 0.0;
    int evaluations = 0;  ///< of the model
    bool converged = false;
    std::string termination;  ///< in the solver's words
};

/// The position of each free parameter between its bounds, 0 to 1: the coordinates in which solvers work.
[[nodiscard]] std::vector<double> to_unit_box(const FitProblem& problem, std::span<const double> values);
[[nodiscard]] std::vector<double> from_unit_box(const FitProblem& problem, std::span<const double> positions);

/// The starts of the free parameters.
[[nodiscard]] std::vector<double> starts(const FitProblem& problem);

/// Minimises chi2 from the problem's starts by Ceres' trust-region method with bounds and the exact Jacobian.
[[nodiscard]] Minimum minimise_by_ceres(const Objective& objective);

/// Minimises chi2 from the problem's starts by NLopt's BOBYQA, which uses no derivatives [POWELL09].
[[nodiscard]] Minimum minimise_by_bobyqa(const Objective& objective);

}  // namespace skinfit
