#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/fit_scale.hpp"
#include "fit/objective.hpp"

namespace skinfit {

/// Where a solver ended.
struct Minimum {
    std::vector<double> values;  ///< of the free parameters
    double chi2 = 0.0;           ///< `Objective::chi2`
    double cost = 0.0;           ///< `Misfit::cost`: what was minimised
    int evaluations = 0;         ///< of the model
    bool converged = false;      ///< `expected_gain` is below `negligible_gain`
    std::string termination;     ///< in the solver's words
};

/// The starts of the free parameters.
[[nodiscard]] std::vector<double> starts(const FitProblem& problem);

/// By how much the linearised cost at `values`, where the misfit is `misfit`, falls within a step of about the size of
/// the unit box, parameters that are pressed against a bound held: g (J'J + 1)^-1 g for the gradient g and the Jacobian
/// J by positions. It vanishes at a minimum, and a direction along which the cost is flat adds nothing.
[[nodiscard]] double expected_gain(const FitProblem& problem, const Misfit& misfit, std::span<const double> values);

/// A lower cost than another by more than this is a better minimum: a cost that can fall by less moves no parameter by
/// more than a thirtieth of its standard deviation.
inline constexpr double negligible_gain = 1e-3;

/// The termination of a method that was not given the evaluations to end by itself.
inline constexpr const char* out_of_evaluations = "out of evaluations";

/// Fills in cost, chi2 and convergence at the values of `minimum`.
void judge(const Objective& objective, Minimum& minimum);

/// The solvers' conclusion: cost, chi2 and convergence at `positions` in the unit box.
[[nodiscard]] Minimum concluded(const Objective& objective, std::span<const double> positions, int evaluations,
                                const std::string& termination);

/// Minimises the cost from `start` by Ceres' trust-region method with the exact Jacobian and an active set of bounds.
[[nodiscard]] Minimum minimise_by_ceres(const Objective& objective, std::span<const double> start);

/// Minimises the cost from `start` by a method of NLopt: BOBYQA [POWELL09], SBPLX [ROWAN90], SLSQP [KRAFT94], or CRS2
/// [KAELO06], which takes its random numbers from the problem's seed and is finished by BOBYQA. Stops after about
/// `most_evaluations`, or where the method's own limit lies.
[[nodiscard]] Minimum minimise_by_nlopt(const Objective& objective, Solver solver, std::span<const double> start,
                                        std::optional<int> most_evaluations = {});

/// The same by any solver; `most_evaluations` are for methods without derivatives, which need many.
[[nodiscard]] Minimum minimise(const Objective& objective, Solver solver, std::span<const double> start,
                               std::optional<int> most_evaluations = {});

}  // namespace skinfit
