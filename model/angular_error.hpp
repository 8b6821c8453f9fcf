#pragma once

#include <array>
#include <span>

#include "model/angular_solver.hpp"

/// How far the angular solver is from the law it solves. docs/model.md, section "Stated error".
namespace skinfit {

/// How much finer the resolutions are from whose shares the error of a share is estimated.
inline constexpr std::array<double, 2> finer_resolutions = {1.5, 2.0};

/// How far `share` may be from the converged share, where `finer` are the same share at `finer_resolutions`: measured
/// on random specimens, no proven bound. A share that is exactly 0 at all resolutions has no error.
[[nodiscard]] double stated_solver_error(double share, std::span<const double, finer_resolutions.size()> finer);

/// The stated errors of the shares of one wavelength; the surface has none.
struct SolverErrors {
    double reflected;
    double transmitted;
    double viewed;
};

/// Estimates the errors of a solver. Costs about ten times as much as the shares themselves.
class SolverErrorEstimate {
public:
    explicit SolverErrorEstimate(const AngularSolver& solver);

    /// The errors at one wavelength. Throws InputError outside the tables.
    [[nodiscard]] SolverErrors at(double wavelength_nm) const;

private:
    AngularSolver solver_;
    std::array<AngularSolver, finer_resolutions.size()> finer_;
};

}  // namespace skinfit
