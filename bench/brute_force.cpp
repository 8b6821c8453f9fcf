#include "bench/brute_force.hpp"

#include <nlopt.hpp>

#include "fit/fit_scale.hpp"
#include "fit/minimum.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {
namespace {

/// What the cost needs behind NLopt's plain function pointer.
struct Counter {
    const FitProblem* problem;
    int evaluations = 0;
};

double chi2_at(const std::vector<double>& positions, std::vector<double>& /*gradient*/, void* data) {
    auto* const counter = static_cast<Counter*>(data);
    ++counter->evaluations;
    const FitProblem& problem = *counter->problem;
    Experiment experiment = problem.only().experiment;
    const std::vector<double> values = from_unit_box(problem, positions);
    for (std::size_t i = 0; i < values.size(); ++i) {
        value_of(experiment.values, problem.free[i].parameter) = values[i];
    }
    double chi2 = 0.0;
    std::size_t row = 0;
    for (const Reading& reading :
         read_by_walk(experiment, problem.only().wavelength_nm, problem.only().walk.rays, problem.only().walk.seed)) {
        const double residual = (reading.reflectance - problem.only().measured[row]) / problem.only().sigma[row];
        chi2 += residual * residual;
        ++row;
    }
    return chi2;
}

}  // namespace

BruteForce fit_by_brute_force(const FitProblem& problem, int most_evaluations) {
    std::vector<double> positions = to_unit_box(problem, starts(problem));
    Counter counter{&problem};
    nlopt::opt solver(nlopt::LN_BOBYQA, static_cast<unsigned>(positions.size()));
    solver.set_min_objective(chi2_at, &counter);
    solver.set_lower_bounds(0.0);
    solver.set_upper_bounds(1.0);
    solver.set_initial_step(0.05);
    solver.set_ftol_rel(1e-10);
    solver.set_maxeval(most_evaluations);
    double chi2 = 0.0;
    const Stopwatch watch;
    (void)solver.optimize(positions, chi2);
    return {.evaluations = counter.evaluations, .duration = watch.elapsed(), .chi2 = chi2};
}

}  // namespace skinfit
