#include <cmath>
#include <nlopt.hpp>

#include "fit/minimum.hpp"

namespace skinfit {
namespace {

/// What the objective needs behind NLopt's plain function pointer.
struct Counter {
    const Objective* objective;
    int evaluations = 0;
};

double chi2_at(const std::vector<double>& positions, std::vector<double>& /*gradient*/, void* data) {
    auto* const counter = static_cast<Counter*>(data);
    ++counter->evaluations;
    return counter->objective->chi2(from_unit_box(counter->objective->problem(), positions));
}

std::string words(nlopt::result result) {
    switch (result) {
        case nlopt::SUCCESS:
            return "success";
        case nlopt::STOPVAL_REACHED:
            return "stop value reached";
        case nlopt::FTOL_REACHED:
            return "chi2 no longer falls";
        case nlopt::XTOL_REACHED:
            return "steps below the tolerance";
        case nlopt::MAXEVAL_REACHED:
            return "out of evaluations";
        case nlopt::MAXTIME_REACHED:
            return "out of time";
        default:
            return "stopped with an error";
    }
}

}  // namespace

Minimum minimise_by_bobyqa(const Objective& objective, std::span<const double> start) {
    const FitProblem& problem = objective.problem();
    const auto count = static_cast<unsigned>(objective.free_count());
    // BOBYQA interpolates at 2 n + 1 points and refuses a single parameter; COBYLA serves there.
    nlopt::opt solver(count > 1 ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, count);
    Counter counter{&objective};
    solver.set_min_objective(chi2_at, &counter);
    solver.set_lower_bounds(0.0);
    solver.set_upper_bounds(1.0);
    solver.set_initial_step(0.05);
    solver.set_xtol_abs(1e-8);  // of the unit box
    solver.set_ftol_rel(1e-13);
    solver.set_maxeval(5000);
    std::vector<double> positions = to_unit_box(problem, start);
    double chi2 = 0.0;
    Minimum minimum;
    try {
        const nlopt::result result = solver.optimize(positions, chi2);
        minimum.converged = result != nlopt::MAXEVAL_REACHED && result > 0;
        minimum.termination = words(result);
    } catch (const nlopt::roundoff_limited&) {
        minimum.converged = true;
        minimum.termination = "steps at the limit of rounding";
    } catch (const std::runtime_error& error) {
        minimum.termination = error.what();
    }
    minimum.values = from_unit_box(problem, positions);
    minimum.chi2 = objective.chi2(minimum.values);
    minimum.evaluations = counter.evaluations;
    return minimum;
}

}  // namespace skinfit
