#pragma once

#include <Eigen/Core>

/// Whether chains of a sampler agree, and how many independent draws they are worth [VEHTARI21]. Matrices hold one
/// quantity: draws x chains, an even number of at least four draws.
namespace skinfit {

/// The rank-normalised split R-hat, the larger of that of the draws and of their distances from the median: near 1
/// where all chains sample the same distribution, below 1.01 as it should be.
[[nodiscard]] double r_hat(const Eigen::MatrixXd& draws);

/// The effective sample size for the centre of the distribution, from rank-normalised split chains.
[[nodiscard]] double bulk_effective_size(const Eigen::MatrixXd& draws);

/// The smaller of the effective sample sizes for the 5 % and the 95 % quantile.
[[nodiscard]] double tail_effective_size(const Eigen::MatrixXd& draws);

/// The effective sample size for the mean, from split chains.
[[nodiscard]] double mean_effective_size(const Eigen::MatrixXd& draws);

/// The value below which a share of all draws lies, linear between them.
[[nodiscard]] double quantile(const Eigen::MatrixXd& draws, double share);

}  // namespace skinfit
