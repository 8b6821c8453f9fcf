#pragma once

#include <string>
#include <vector>

#include "fit/result.hpp"

namespace skinfit {

/// What is wrong with a fit, in the order of the checks, and what follows from it.
struct Diagnosis {
    Verdict verdict;
    std::vector<std::string> reasons;  ///< `<what>; <what to do>`
};

/// A p-value below which chance is no explanation.
inline constexpr double improbable = 1e-3;

/// The 99 % quantile of `FitResult::departure_rms` over the discrepancy's sigma: of 2352 spectra of [COOKSEY17],
/// [XIAO16] and [VRHEL94] fitted with preset skin.
inline constexpr double largest_usual_departure = 1.47;

/// Judges a result by its other fields.
/// Failed where the cost could still fall (`Minimum::converged`): a flat direction is no failure.
/// Suspect where
///   chi2 is improbable under noise and discrepancy (p below `improbable`), or no degree of freedom is left to test it;
///   the slow part of the residuals, whitened by noise and discrepancy, is improbably large (`slow_residuals_p_value`
///   below `improbable`); the discrepancy takes more than `largest_usual_departure` times its sigma;
///   another minimum costs at most 3.84 more; a free parameter lies at a bound, but for an upper limit
///   (`is_upper_limit`), or is not identifiable; an answer leaves its interval under another assumption
///   (`answers_moved`); the Monte Carlo error of the reading exceeds half the noise; another solver found a cost lower
///   by more than 1e-3, or the same cost with a parameter more than 0.1 sigma away; there are fewer wavelengths than
///   free parameters; profiling met a better minimum; the chains of a posterior have not mixed (R-hat not below 1.01,
///   or fewer than 400 effective draws) or diverged.
[[nodiscard]] Diagnosis diagnose(const FitResult& result);

/// Whether the residuals are smaller than noise and discrepancy let them be by chance: these are stated too large, and
/// the intervals are wide. A note, no reason for doubt.
[[nodiscard]] bool is_chi2_small(const FitResult& result);

}  // namespace skinfit
