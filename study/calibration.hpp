#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "study/interval_estimate.hpp"

/// Whether predicted probabilities come true as often as they say.
namespace skinfit {

/// The probability predicted for one case, and what it was.
struct PredictedCase {
    std::optional<double> probability;  ///< 0 to 1; none, or not a number: it has none, and is counted only
    bool is_positive;
};

/// Neighbouring cases in order of their probability.
struct CalibrationBin {
    double lowest_probability;
    double highest_probability;
    double mean_probability;
    Proportion observed;  ///< positive ones among the cases of the bin
};

/// How probabilities compare with what happened. All tests take the cases as independent.
struct CalibrationAnalysis {
    std::size_t cases;  ///< with a probability
    std::size_t without_probability;
    std::vector<CalibrationBin> bins;  ///< in ascending order
    std::size_t observed_positives;
    double expected_positives;     ///< sum of the probabilities
    double expected_positives_sd;  ///< if they are right
    /// Two-sided, by the normal distribution; none where the probabilities are all 0 or 1 and come true.
    std::optional<double> positives_p_value;
    double brier_score;           ///< mean square of outcome - probability
    double expected_brier_score;  ///< if the probabilities are right
    /// Spiegelhalter's z, of the Brier score: positive where probabilities are too extreme, negative where they are too
    /// timid; standard normal if they are right [SPIEGELHALTER86]. None where all are 0, 1/2 or 1 and none is refuted.
    std::optional<double> spiegelhalter_z;
    std::optional<double> spiegelhalter_p_value;  ///< two-sided
};

/// Compares in at most `bins` (1 or more) bins of nearly equal count; equal probabilities stay together, which may make
/// bins fewer. None without a case that has a probability.
[[nodiscard]] std::optional<CalibrationAnalysis> calibration_analysis(const std::vector<PredictedCase>& cases,
                                                                      std::size_t bins = 10);

}  // namespace skinfit
