#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "fit/inference.hpp"

/// Recovery studies: spectra of known skin, drawn at random, with noise, analysed as if nothing were known of them.
namespace skinfit {

/// Readings at the wavelengths of the problem, and what is random in them.
struct SimulatedReadings {
    Eigen::VectorXd reading;         ///< fractions
    Eigen::VectorXd standard_error;  ///< of the noise that they have already, independent from reading to reading
};

/// The readings of a skin with these values of the free parameters, spectrum `number` of a study, without the noise of
/// an instrument; called from several threads at a time.
using Simulator = std::function<SimulatedReadings(std::span<const double> values, std::uint64_t number)>;

/// The design of a recovery study.
struct RecoveryDesign {
    std::uint64_t spectra = 1000;
    double noise = 0.003;  ///< standard deviation of a reading, fraction; the problem's sigma is set to it
    std::uint64_t seed = 1;
    std::size_t starts = 8;            ///< of the search that is judged, by Ceres
    std::size_t thorough_starts = 32;  ///< of the one that it is judged by, elsewhere in the box
    std::array<bool, uncertainty_method_count> intervals{true, true, true};  ///< which kinds are computed
};

/// Whoever waits for a recovery study.
struct RecoveryWatch {
    std::stop_token stop{};                              ///< asks for an end after the spectra at hand
    std::function<void(std::uint64_t done)> progress{};  ///< empty: nobody listens; called from any thread
};

/// What became of one parameter of one spectrum.
struct RecoveredParameter {
    double truth;
    double estimate;
    struct Interval {
        Status status;
        Bounds interval_95;
    };
    std::array<std::optional<Interval>, uncertainty_method_count> intervals;
    std::optional<int> rank;  ///< how many of `ranked_draws` draws of the posterior lie below the truth
};

/// Draws of the posterior among which the truth is ranked, spaced so that they are nearly independent.
inline constexpr int ranked_draws = 99;

/// What became of one spectrum.
struct RecoveredSpectrum {
    std::vector<RecoveredParameter> parameters;  ///< in the order of `FitProblem::free`
    bool converged;
    double cost;                         ///< where the search from `RecoveryDesign::starts` ended
    double best_cost;                    ///< the lowest known: of any search, met while profiling, or of the truth
    double other_cost;                   ///< where BOBYQA's search from the same starts ended
    std::optional<double> other_sigmas;  ///< how far from there, as `largest_difference`
    double worst_r_hat;
    int divergences;
};

/// Draws `design.spectra` skins, each free parameter from its prior within its bounds (uniform where it has none) and
/// all of them as priors on derived quantities say, simulates each with `simulate`, adds what noise is missing, and
/// fits `problem` to it over `models`. Where `watch.stop` ends it, those that are finished are returned. Spectra in
/// parallel, the same results on any number of threads. Throws InputError where the simulated readings have more noise
/// than the design wants.
[[nodiscard]] std::vector<RecoveredSpectrum> recover(const FitProblem& problem, const std::vector<ForwardModel>& models,
                                                     const Simulator& simulate, const RecoveryDesign& design,
                                                     const RecoveryWatch& watch = {});

}  // namespace skinfit
