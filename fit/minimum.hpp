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

/// Minimises chi2 from `start` by Ceres' trust-region method with the exact Jacobian and an active set of bounds.
[[nodiscard]] Minimum minimise_by_ceres(const Objective& objective, std::span<const double> start);

/// Minimises chi2 from `start` by NLopt's BOBYQA, which uses no derivatives [POWELL09].
[[nodiscard]] Minimum minimise_by_bobyqa(const Objective& objective, std::span<const double> start);

}  // namespace skinfit
