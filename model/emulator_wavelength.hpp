#pragma once

#include <array>
#include <vector>

#include "model/angular_error.hpp"
#include "model/angular_solver.hpp"
#include "model/depth_box.hpp"
#include "model/emulator.hpp"

namespace skinfit {

/// Loops over terms end with the last of this size, and the nodes suffice where the series along a layer has fallen
/// below it. The error this leads to is found by `certify`.
inline constexpr double least_coefficient = 5e-7;

/// Optical depths of the layers of several specimens.
using DepthVector = std::vector<PerLayer<double>>;

/// One wavelength on the way to an emulator.
struct EmulatedWavelength {
    DepthBox box;
    std::array<int, layer_count> counts;  // of nodes, and of coefficients
    std::vector<double> coefficients;     // tensor, last layer fastest
    DepthVector test_upper;               // the specimens on which the error is found: all combinations of upper
    DepthVector test_lower;               // and lower layers
    ShareTable test_shares;
    double solver_error = 0.0;  // the largest that the solver states
};

/// The solver whose shares are expanded, and the finer ones that tell its error.
struct EmulatorSolvers {
    AngularSolver solver;
    std::array<AngularSolver, finer_resolutions.size()> finer;
};

/// The series of one wavelength, with the shares on which its error is found.
[[nodiscard]] EmulatedWavelength emulated_wavelength(const EmulatorSolvers& solvers, const EmulatorDomain& domain,
                                                     double wavelength_nm);

}  // namespace skinfit
