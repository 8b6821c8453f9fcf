#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fit/box_misfit.hpp"
#include "fit/nuts.hpp"

namespace skinfit {

/// How to sample.
struct SamplingOptions {
    std::uint64_t seed = 1;
    int chains = 4;
    int warm_up = 300;                ///< transitions of each chain that are lost
    double effective_samples = 1000;  ///< wanted of every parameter, for centre and tails
    int most_draws = 4000;            ///< of each chain
};

/// Rows of `draws` with one another.
[[nodiscard]] Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& draws);

/// What the draws say of one parameter: positions in the unit box, in a result values.
struct Marginal {
    double median;
    double mean;
    double sigma;
    double lower;  ///< 2.5 % quantile
    double upper;  ///< 97.5 % quantile
    double r_hat;
    double bulk_effective_size;
    double tail_effective_size;
};

/// Draws from the posterior over the unit box: exp(-cost / 2 + `Misfit::log_volume`).
struct Posterior {
    std::vector<Marginal> marginals;
    Eigen::MatrixXd correlation;
    Eigen::MatrixXd draws;  ///< parameters x draws, chain after chain
    int chains;
    int divergences;
    std::int64_t evaluations;
};

/// That density over the unit box as one of the logits of the positions, so that a bound is infinitely far
/// away and a density that is largest at a bound is sampled right.
[[nodiscard]] DensityFunction logit_density(const BoxMisfit& misfit);

/// Samples it: chains in parallel from around `minimum`, a first mass matrix by Laplace's
/// approximation there, draws until every parameter has the wanted effective samples. Depends on the seed alone, not on
/// the number of threads. `misfit` is called from several threads at a time.
[[nodiscard]] Posterior sample_posterior(const BoxMisfit& misfit, const Eigen::VectorXd& minimum,
                                         const SamplingOptions& options);

}  // namespace skinfit
