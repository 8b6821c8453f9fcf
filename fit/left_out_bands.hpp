#pragma once

#include <span>

#include "fit/objective.hpp"

namespace skinfit {

/// How well the model of a problem with one measurement predicts what it has not seen: the root mean square error,
/// fraction, with which bands of 30 nm follow from the rest of the spectrum. Without a band the free parameters are
/// found again by the linearised model at `values`, within their bounds; what the discrepancy takes of the rest is
/// carried into the band by its kernel [RASMUSSEN06, Eq. 2.23]. Weights and loss do not count.
[[nodiscard]] double left_out_rmse(const Objective& objective, std::span<const double> values);

}  // namespace skinfit
