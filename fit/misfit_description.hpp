#pragma once

#include <vector>

#include "fit/objective.hpp"
#include "fit/result.hpp"

namespace skinfit {

/// Fills in how closely the model explains the spectra of the objective's problem at `minimum`, and its own error:
/// everything of `result` from the spectra to the inflation.
void describe_misfit(const Objective& objective, const Minimum& minimum, FitResult& result);

/// The median of `values`; 0 of none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace skinfit
