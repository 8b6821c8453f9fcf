#pragma once

#include <Eigen/Core>
#include <optional>

namespace skinfit {

/// The probability that the slow part of `residuals` (white, of unit variance, in the order of wavelengths) is as large
/// by chance: of the sums of squares of their 2, 4, 8, ... slowest cosines, up to half of them, the least probable by
/// chi2, times the number of sums, at most 1. `fitted` (rows as residuals, orthonormal columns) spans what the fit
/// takes away; a sum has as many degrees of freedom less as it lies in that. None where the fit takes all of the slow
/// part.
[[nodiscard]] std::optional<double> slow_residuals_p_value(const Eigen::VectorXd& residuals,
                                                           const Eigen::MatrixXd& fitted);

}  // namespace skinfit
