#pragma once

#include <optional>
#include <span>

namespace skinfit {

/// The probability that independent residuals of random sign change sign as rarely as these, given how many are
/// positive: exact, one-sided [WALD40]. None for residuals all of one sign, of which the number of runs says nothing.
[[nodiscard]] std::optional<double> runs_p_value(std::span<const double> residuals);

}  // namespace skinfit
