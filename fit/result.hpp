#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/inference.hpp"
#include "fit/minimum.hpp"
#include "fit/multistart.hpp"
#include "fit/resolution.hpp"
#include "fit/uncertainty.hpp"
#include "measurements/quality.hpp"

namespace skinfit {

/// Whether the answer can be used.
enum class Verdict { consistent, suspect, failed };

/// One parameter of a fit, free or fixed.
struct FittedParameter {
    Parameter parameter;
    std::string name;  ///< `name_of` the free parameter, else of the parameter
    double value;
    double start;                      ///< of the first search
    Bounds bounds;                     ///< within the support of the prior
    ParameterUncertainty uncertainty;  ///< of a fixed parameter: Status::fixed and the value as interval
    std::optional<Prior> prior{};      ///< of a free parameter; unset: uniform within the bounds
};

/// The answer of one solver, for comparison with another.
struct SolverAnswer {
    Solver solver;
    Minimum minimum;
    double seconds = 0.0;  ///< of all its searches
};

/// One spectrum and its explanation.
struct FittedSpectrum {
    std::string name;
    std::string source;
    std::string unit_rule;
    std::string sigma_source;
    ResolvedConfiguration configuration;
    double rmse = 0.0;  ///< of reading minus measurement, fraction
    double chi2 = 0.0;  ///< as `FitResult::chi2`, of this spectrum alone
    std::vector<double> wavelength_nm;
    std::vector<double> measured;
    std::vector<double> sigma;
    std::vector<double> modelled;
    std::vector<Bounds> modelled_95{};  ///< of each modelled reading: `model_band`
};

/// The answers of fits under other assumptions than those of the fit.
struct OtherAssumptions {
    /// A quantity that should not depend on them, as the fit itself answers.
    struct Answer {
        std::string name;
        double value;
        Bounds interval_95;
    };
    /// One of them.
    struct Alternative {
        std::string assumption;      ///< in words
        double left_out_rmse;        ///< `left_out_rmse` under it
        std::vector<double> values;  ///< in the order of `answers`; not finite where it does not have one
    };
    std::vector<Answer> answers;
    double left_out_rmse = 0.0;  ///< of the fit itself
    std::vector<Alternative> alternatives;
};

/// Everything a report needs.
struct FitResult {
    Verdict verdict = Verdict::failed;
    std::vector<std::string> reasons;     ///< each with its remedy; empty when consistent
    std::vector<FittedSpectrum> spectra;  ///< at least one
    std::vector<Finding> findings;        ///< on the spectra, made before the fit
    double rmse = 0.0;                    ///< of reading minus measurement, over all spectra, fraction
    double chi2 = 0.0;  ///< of the data alone, whitened by noise and discrepancy: without weights, loss and priors
    double cost = 0.0;  ///< what was minimised
    /// The expectation of chi2 where model, noise and priors are right: wavelengths minus parameters as far as the data
    /// determine them, which without priors is all of them.
    double degrees_of_freedom = 0.0;
    std::optional<double> p_value;  ///< of chi2; none without degrees of freedom
    /// That the slow part of the whitened residuals is as large by chance: the least `slow_residuals_p_value` of the
    /// spectra, times their number.
    std::optional<double> slow_residuals_p_value;
    double unexplained_rmse = 0.0;   ///< root mean square of the residuals less what the discrepancy takes, fraction
    double departure_rms = 0.0;      ///< root mean square of what the discrepancy takes, fraction
    double median_sigma = 0.0;       ///< of the measurement
    double monte_carlo_error = 0.0;  ///< median standard error of the modelled reading
    std::optional<double> emulator_error;  ///< largest, certified, of the share that leaves; engine emulator only
    std::optional<double> solver_error;    ///< largest stated, of the share that leaves; engine solver only
    std::vector<FittedParameter> free;     ///< in the order of the parameter table; rows of `correlation`
    std::vector<FittedParameter> fixed;    ///< the others, in that order
    Eigen::MatrixXd correlation;
    Identifiability identifiability;
    std::optional<Profile> profile;      ///< in values, where the intervals are those of profiles
    std::optional<Posterior> posterior;  ///< in values, where the intervals are those of the posterior
    std::optional<double> inflation;     ///< sqrt(chi2 / degrees of freedom); none without degrees of freedom
    SolverAnswer answer;
    /// Those of the answer's solver; the first minimum is the answer. One at which no search ended was met by a
    /// profile.
    Searches searches;
    std::vector<std::string> priors;  ///< in use, in words
    /// What a stop has left out, in words; see `FitWatch::keeps_partial_result`.
    std::vector<std::string> unfinished;
    std::optional<OtherAssumptions> other_assumptions;  ///< none where they were not tried: `try_other_assumptions`
    std::vector<SolverAnswer> cross_check;              ///< other solvers on the same objective; empty unless asked for
    /// The fit can be run again from it: of one spectrum resolved, of several as stated.
    Configuration configuration;
};

/// Whether the parameter ended at 0, where skin may have none of it (`may_be_absent`): its interval is an upper limit.
[[nodiscard]] bool is_upper_limit(const FittedParameter& fitted);

/// The number of readings of all spectra.
[[nodiscard]] std::size_t reading_count(const FitResult& result);

/// Whether anything but chi2 was minimised.
[[nodiscard]] bool has_own_cost(const FitResult& result);

/// What was minimised, as a heading: "chi2" where it is nothing else, and "cost", explained in `cost_words`.
[[nodiscard]] std::string_view cost_name(const FitResult& result);

/// What a cost consists of, as in "chi2 with loss huber and what 1 prior adds".
[[nodiscard]] std::string cost_words(const FitResult& result);

/// Largest difference of a free parameter between two answers, in standard deviations of the result, by natural
/// coordinates; none when no parameter has one.
[[nodiscard]] std::optional<double> largest_difference_in_sigmas(const FitResult& result, const Minimum& other);

}  // namespace skinfit
