#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fit/plot_sheet.hpp"
#include "fit/settings.hpp"
#include "validation/inverse_study.hpp"

namespace skinfit {

/// How often one kind of interval covered the truth, among the spectra in which the parameter was identifiable by it.
struct Coverage {
    std::size_t identifiable;
    std::size_t covered;

    /// 0 to 1; some must be identifiable.
    [[nodiscard]] double share() const { return static_cast<double>(covered) / static_cast<double>(identifiable); }
    /// Whether the share lies within 93 to 97 %, or within what chance makes of 95 %; without any nothing is decided.
    [[nodiscard]] std::optional<bool> passes() const;
};

/// How well one parameter was recovered.
struct ParameterRecovery {
    Parameter parameter;
    double bias;                    ///< mean of estimate - truth, where identifiable by the first kind of interval
    double root_mean_square_error;  ///< of the same
    std::array<std::optional<Coverage>, uncertainty_method_count> coverage;
    std::vector<std::size_t> ranks;      ///< of the truth among draws of the posterior, in equal bins
    std::optional<double> rank_p_value;  ///< of Pearson's test that they are equally full; none without a posterior

    /// Whether the ranks are as even as chance makes them; true without any.
    [[nodiscard]] bool ranks_pass() const;
    /// Whether the coverage of this kind of interval passes; nothing where there is none, and of covariance intervals,
    /// which are the linearised model's and judged by nobody.
    [[nodiscard]] std::optional<bool> coverage_passes(UncertaintyMethod method) const;
};

/// So many of all spectra, and how many may be missing.
struct Agreement {
    std::size_t spectra;
    std::size_t agreeing;
    double wanted_share;

    /// 0 to 1.
    [[nodiscard]] double share() const { return static_cast<double>(agreeing) / static_cast<double>(spectra); }
    /// Whether it is as large as wanted, or as small as chance makes it where each spectrum agrees with that
    /// probability.
    [[nodiscard]] bool passes() const;
};

/// A recovery study in short.
struct RecoverySummary {
    std::size_t spectra;
    std::vector<ParameterRecovery> parameters;
    Agreement best_minimum;        ///< searches that ended within 1e-3 of the lowest cost known
    Agreement solvers_cost;        ///< Ceres and BOBYQA: costs that differ by 1e-6 of them at most
    Agreement solvers_parameters;  ///< and parameters by 0.05 sigma at most
    std::size_t not_converged;
    std::size_t not_mixed;  ///< R-hat of 1.01 or more in any parameter
    std::size_t diverged;   ///< any divergence
};

/// Of all parameters and spectra.
[[nodiscard]] RecoverySummary summarised(const std::vector<RecoveredSpectrum>& spectra,
                                         const std::vector<FreeParameter>& free);

/// Whether nothing that the study judges fails. A rule fails where chance would do so in less than one study of 1000.
[[nodiscard]] bool passes(const RecoverySummary& summary);

/// One row per spectrum and parameter: truth, estimate, status and interval of each kind, rank; and how the searches of
/// the spectrum ended. What was not computed is empty.
[[nodiscard]] std::string recovery_csv(const std::vector<RecoveredSpectrum>& spectra,
                                       const std::vector<FreeParameter>& free);

/// The summary for people, with verdicts.
[[nodiscard]] std::string recovery_text(const RecoverySummary& summary);

/// The same for programs.
[[nodiscard]] Json recovery_json(const RecoverySummary& summary);

/// A column per parameter. Above, its rank histogram, where there are ranks; below, how often each kind of interval
/// covers the truth in each tenth of the spectra, in order of the truth.
[[nodiscard]] PlotSheet recovery_sheet(const std::vector<RecoveredSpectrum>& spectra, const RecoverySummary& summary);

}  // namespace skinfit
