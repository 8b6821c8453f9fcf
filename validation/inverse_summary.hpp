#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "validation/inverse_study.hpp"

namespace skinfit {

/// How often one kind of interval covered the truth, among the spectra in which the parameter was identifiable by it.
struct Coverage {
    std::size_t identifiable;
    std::size_t covered;

    [[nodiscard]] double share() const { return static_cast<double>(covered) / static_cast<double>(identifiable); }
    /// Whether the share lies within 93 to 97 %; too few identifiable spectra decide nothing.
    [[nodiscard]] std::optional<bool> passes() const;
};

/// How well one parameter was recovered.
struct ParameterRecovery {
    Parameter parameter;
    double bias;                    ///< mean of estimate - truth, where identifiable by profile
    double root_mean_square_error;  ///< of the same
    std::array<Coverage, uncertainty_methods> coverage;
    std::vector<std::size_t> ranks;  ///< of the truth among draws of the posterior, in equal bins
    double rank_p_value;             ///< of Pearson's test that they are equally full; 1 without a posterior
};

/// A recovery study in short.
struct RecoverySummary {
    std::size_t spectra;
    std::vector<ParameterRecovery> parameters;
    std::size_t not_converged;
    std::size_t missed_minimum;  ///< the truth has a lower cost than the fit, which proves a better minimum
    std::size_t not_mixed;       ///< R-hat of 1.01 or more in any parameter
    std::size_t diverged;        ///< any divergence
};

[[nodiscard]] RecoverySummary summarised(const std::vector<RecoveredSpectrum>& spectra,
                                         const std::vector<FreeParameter>& free);

/// One row per spectrum and parameter: truth, estimate, status and interval of each kind, rank.
[[nodiscard]] std::string recovery_csv(const std::vector<RecoveredSpectrum>& spectra,
                                       const std::vector<FreeParameter>& free);

/// The summary for people, with verdicts.
[[nodiscard]] std::string recovery_text(const RecoverySummary& summary);

}  // namespace skinfit
