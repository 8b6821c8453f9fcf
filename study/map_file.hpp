#pragma once

#include <string>

#include "fit/problem.hpp"
#include "measurements/envi_writer.hpp"
#include "measurements/spectral_cube.hpp"

namespace skinfit {

/// What the header of the map of `cube` says: the planes of `problem`, where the cube lies, and a description with the
/// program and its version, the cube, `configuration_hash` (of everything that decides the numbers) and the meaning of
/// the numbers of status and reason.
[[nodiscard]] EnviOutput map_output(const FitProblem& problem, const SpectralCube& cube,
                                    const std::string& configuration_hash);

}  // namespace skinfit
