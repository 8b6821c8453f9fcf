#include "model/angular_error.hpp"

#include <algorithm>
#include <cmath>

namespace skinfit {

double stated_solver_error(double share, std::span<const double, finer_resolutions.size()> finer) {
    // Chosen to cover the errors of random specimens over all limits, with half as much again: docs/model.md.
    constexpr double least = 5e-5;
    constexpr double margin = 3.0;
    double change = 0.0;
    for (const double other : finer) change = std::max(change, std::abs(other - share));
    return share == 0.0 && change == 0.0 ? 0.0 : least + margin * change;
}

SolverErrorEstimate::SolverErrorEstimate(const AngularSolver& solver)
    : solver_(solver), finer_{solver.refined(finer_resolutions[0]), solver.refined(finer_resolutions[1])} {}

SolverErrors SolverErrorEstimate::at(double wavelength_nm) const {
    const AngularResponse response = solver_.shares(wavelength_nm);
    const std::array<AngularResponse, 2> finer = {finer_[0].shares(wavelength_nm), finer_[1].shares(wavelength_nm)};
    const auto error = [&](AngularShare AngularResponse::*share) {
        return stated_solver_error((response.*share).share,
                                   std::array{(finer[0].*share).share, (finer[1].*share).share});
    };
    return {.reflected = error(&AngularResponse::reflected),
            .transmitted = error(&AngularResponse::transmitted),
            .viewed = error(&AngularResponse::viewed)};
}

}  // namespace skinfit
