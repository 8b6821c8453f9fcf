#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fit/inference.hpp"

/// Recovery studies: spectra of known skin, drawn at random, with noise, analysed as if nothing were known of them.
namespace skinfit {

/// The readings of a skin with these values of the free parameters, without noise, at the wavelengths of the problem.
using Simulator = std::function<Eigen::VectorXd(std::span<const double> values)>;

/// How an objective is minimised; called from several threads at a time.
using Minimiser = std::function<Minimum(const Objective& objective)>;

/// The design of a recovery study.
struct RecoveryDesign {
    std::uint64_t spectra = 1000;
    double noise = 0.003;  ///< standard deviation of a reading, fraction; the problem's sigma is set to it
    std::uint64_t seed = 1;
    bool with_posterior = true;
};

inline constexpr std::size_t uncertainty_methods = 3;  ///< as in `UncertaintyMethod`

/// What became of one parameter of one spectrum.
struct RecoveredParameter {
    double truth;
    double estimate;
    struct Interval {
        Status status;
        Bounds interval_95;
    };
    std::array<Interval, uncertainty_methods> intervals;  ///< not identifiable by a posterior that was not sampled
    int rank;  ///< how many of `ranked_draws` draws of the posterior lie below the truth
};

/// Draws of the posterior among which the truth is ranked, spaced so that they are nearly independent.
inline constexpr int ranked_draws = 99;

/// What became of one spectrum.
struct RecoveredSpectrum {
    std::vector<RecoveredParameter> parameters;  ///< in the order of `FitProblem::free`
    bool converged;
    bool better_minimum;   ///< met while profiling
    double chi2_of_truth;  ///< less the cost that the fit reached: below zero, up to rounding, the fit missed the best
    double worst_r_hat;
    int divergences;
};

/// Draws `design.spectra` skins, each free parameter uniformly from its bounds, simulates each with `simulate`, and
/// fits `problem` to it over `model`. Spectra in parallel, the same results on any number of threads.
[[nodiscard]] std::vector<RecoveredSpectrum> recover(const FitProblem& problem, const ForwardModel& model,
                                                     const Simulator& simulate, const Minimiser& minimise,
                                                     const RecoveryDesign& design);

}  // namespace skinfit
