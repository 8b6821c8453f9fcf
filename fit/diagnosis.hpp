#pragma once

#include <string>
#include <vector>

#include "fit/result.hpp"

namespace skinfit {

/// What is wrong with a fit, worst first, and what follows from it.
struct Diagnosis {
    Verdict verdict;
    std::vector<std::string> reasons;  ///< `<what>; <what to do>`
};

/// Judges a result by its other fields:
/// failed where the solver did not converge; suspect where chi2 is improbable under the noise (p below 0.001), where a
/// free parameter lies at a bound or is not identifiable, where the Monte Carlo error of the reading exceeds half the
/// noise, where no degree of freedom is left, where profiling met a better minimum, where the chains of a posterior
/// have not mixed (R-hat not below 1.01 or fewer than 400 effective draws) or diverged, or where another solver found a
/// better or a different minimum (chi2 lower by more than 1e-3, or a parameter more than 0.1 sigma away).
[[nodiscard]] Diagnosis diagnose(const FitResult& result);

}  // namespace skinfit
