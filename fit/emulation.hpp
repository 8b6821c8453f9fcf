#pragma once

#include <vector>

#include "fit/problem.hpp"
#include "model/emulator.hpp"

namespace skinfit {

/// What an emulator must cover for a fit of one of the measurements: the free parameters that absorb, within their
/// bounds.
[[nodiscard]] EmulatorDomain emulator_domain(const FitProblem& problem, std::size_t number = 0);

/// The same for a simulation at `wavelengths_nm`, as the instrument states them: of one geometry.
[[nodiscard]] EmulatorDomain emulator_domain(const Configuration& configuration, Side side,
                                             const std::vector<double>& wavelengths_nm);

}  // namespace skinfit
