#pragma once

#include <span>

#include "fit/objective.hpp"
#include "fit/result.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// Fills in how closely the model explains `spectra`, those of the objective's problem, at `minimum`, and its own
/// error: everything of `result` from the spectra to the inflation. The configuration of `result` must be set.
void describe_misfit(const Objective& objective, const Minimum& minimum, std::span<const Spectrum> spectra,
                     FitResult& result);

/// The median of `values`; 0 of none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace skinfit
