#pragma once

#include <vector>

#include "fit/inference.hpp"
#include "fit/objective.hpp"

namespace skinfit {

/// The 95 % interval of every reading that the model gives, one measurement after the other: how far the curve may lie
/// off where the model is right, without the noise of a new measurement.
///
/// With a posterior, the 2.5 % and 97.5 % quantiles of the readings of 400 of its draws, evenly spread over the chains
/// (all, where there are fewer). Else the linearised model: 1.96 sqrt(diag(J C J')) about the reading, with J its
/// derivatives and C the pseudo-inverse of the information of data and priors, parameters at a bound held. A direction
/// that neither data nor priors determine leaves the readings alone, and so does not widen the band.
[[nodiscard]] std::vector<Bounds> model_band(const Objective& objective, const Inference& inference);

}  // namespace skinfit
