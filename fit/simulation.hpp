#pragma once

#include <vector>

#include "fit/nuts.hpp"
#include "fit/problem.hpp"

/// What all simulations of measurements of drawn skin have in common.
namespace skinfit {

/// A spectrum at the configuration's `wavelengths` that stands for a measurement until one is drawn; a ramp, since a
/// constant spectrum would be refused. Throws InputError where they are no wavelengths.
[[nodiscard]] Spectrum blank_spectrum(const Configuration& configuration);

/// Values of the free parameters of a problem with one measurement: each from its prior within its bounds, uniform
/// where it has none; drawn again as often as the priors on derived quantities refuse, since those multiply the density
/// of the others.
[[nodiscard]] std::vector<double> drawn_skin(const FitProblem& problem, ChainRandom& random);

}  // namespace skinfit
