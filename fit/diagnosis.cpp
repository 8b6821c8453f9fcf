#include "fit/diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fit/critical_values.hpp"
#include "fit/minimum.hpp"
#include "fit/other_assumptions.hpp"

namespace skinfit {
namespace {

constexpr double model_error_share = 0.5;                 // of the noise
constexpr double almost_as_well = normal_95 * normal_95;  // of the cost
constexpr double different_sigmas = 0.1;
constexpr double mixed = 1.01;        // R-hat, [VEHTARI21]
constexpr double enough_draws = 400;  // effective, [VEHTARI21]

void judge_spectrum(const FitResult& result, std::vector<std::string>& reasons) {
    std::string names;
    std::set<std::string> named;
    for (const Finding& finding : result.findings) {
        if (finding.severity != Severity::warning || !named.insert(finding.name).second) continue;
        names += (names.empty() ? "" : ", ") + finding.name;
    }
    if (!names.empty()) reasons.push_back(fmt::format("SPECTRUM IN DOUBT: {}; see its findings", names));
}

void judge_misfit(const FitResult& result, std::vector<std::string>& reasons) {
    const std::size_t wavelengths = reading_count(result);
    if (wavelengths < result.free.size()) {
        reasons.push_back(fmt::format(
            "FEWER WAVELENGTHS THAN PARAMETERS: {} for {}, so the priors decide part of the answer; measure "
            "more wavelengths or fix parameters",
            wavelengths, result.free.size()));
    } else if (!result.p_value) {
        reasons.emplace_back(
            "NO DEGREES OF FREEDOM: as many parameters as wavelengths, so nothing tests the model; measure more "
            "wavelengths or fix parameters");
    }
    if (!result.p_value) return;
    if (*result.p_value < improbable) {
        reasons.push_back(fmt::format(
            "MISFIT beyond the noise: chi2 {:.1f} for {:.3g} degrees of freedom (p = {:.1g}), rmse {:.4f} "
            "against a noise of "
            "{:.4f}; check geometry and specular, see what other assumptions change, set discrepancy, or state "
            "larger uncertainties, by the setting noise or in the file where it gives its own",
            result.chi2, result.degrees_of_freedom, *result.p_value, result.rmse, result.median_sigma));
    }
}

/// The remedies lie in how the instrument and the skin are described: the table of other assumptions shows which
/// matter.
void judge_slow_residuals(const FitResult& result, std::vector<std::string>& reasons) {
    if (!result.slow_residuals_p_value || *result.slow_residuals_p_value >= improbable) return;
    const std::optional<Discrepancy>& discrepancy = result.configuration.discrepancy;
    const std::string assumed = discrepancy ? fmt::format("the noise and a discrepancy of {:g} over {:g} nm",
                                                          discrepancy->sigma, discrepancy->length_nm)
                                            : "noise that is independent from wavelength to wavelength";
    reasons.push_back(fmt::format(
        "RESIDUALS IN RUNS: their slow part is larger than {} allows (p = {:.1g}), so the model departs smoothly and "
        "sigmas are too small; {}, and see what other assumptions change",
        assumed, *result.slow_residuals_p_value,
        discrepancy ? "set a larger sigma or a shorter length_nm of the discrepancy" : "set discrepancy"));
}

void judge_departure(const FitResult& result, std::vector<std::string>& reasons) {
    const std::optional<Discrepancy>& discrepancy = result.configuration.discrepancy;
    if (!discrepancy || result.departure_rms <= largest_usual_departure * discrepancy->sigma) return;
    reasons.push_back(fmt::format(
        "UNUSUAL DEPARTURE: the discrepancy takes {:.4f} of the residuals (root mean square), more than {:g} times its "
        "sigma of {:g}, which 99 in 100 measured spectra stay below; check geometry, specular and calibration, and see "
        "what other assumptions change",
        result.departure_rms, largest_usual_departure, discrepancy->sigma));
}

void judge_assumptions(const FitResult& result, std::vector<std::string>& reasons) {
    if (!result.other_assumptions) return;
    const OtherAssumptions& others = *result.other_assumptions;
    for (const OtherAssumptions::Alternative& alternative : others.alternatives) {
        std::string moves;
        for (const std::size_t place : answers_moved(others, alternative)) {
            moves += fmt::format("{}{} would be {:.3g} instead of {:.3g}", moves.empty() ? "" : ", ",
                                 others.answers[place].name, alternative.values[place], others.answers[place].value);
        }
        if (moves.empty()) continue;
        reasons.push_back(
            fmt::format("DEPENDS ON AN ASSUMPTION: with {} {}, outside its interval, and bands left out are predicted "
                        "better ({:.4f} against {:.4f}); state what is known of it",
                        alternative.assumption, moves, alternative.left_out_rmse, others.left_out_rmse));
    }
}

/// What a cost is, between `before` and `after`; empty where it is chi2 and called so.
std::string explained(const FitResult& result, std::string_view before, std::string_view after = "") {
    return has_own_cost(result) ? fmt::format("{}{}{}", before, cost_words(result), after) : "";
}

void judge_minima(const FitResult& result, std::vector<std::string>& reasons) {
    for (std::size_t i = 1; i < result.searches.minima.size(); ++i) {
        const Minimum& other = result.searches.minima[i].minimum;
        if (!other.converged || other.cost - result.cost > almost_as_well) continue;
        const std::optional<double> difference = largest_difference_in_sigmas(result, other);
        reasons.push_back(fmt::format(
            "SECOND MINIMUM: other values of the parameters, up to {:.2g} sigma away, explain the spectrum "
            "almost as well ({} {:.6g} against {:.6g}{}); see the list of minima, and fix or state priors on "
            "what you know",
            difference.value_or(0.0), cost_name(result), other.cost, result.cost, explained(result, "; cost: ")));
    }
}

void judge_parameters(const FitResult& result, std::vector<std::string>& reasons) {
    for (const FittedParameter& fitted : result.free) {
        const std::string& name = fitted.name;
        const Status status = fitted.uncertainty.status;
        if (status == Status::at_lower_bound || status == Status::at_upper_bound) {
            if (is_upper_limit(fitted)) continue;
            const bool at_lower = status == Status::at_lower_bound;
            const ParameterInfo& row = info(fitted.parameter);
            // No configuration can widen a bound that is the parameter's limit.
            const bool is_limit = at_lower ? fitted.bounds.lower <= row.lowest : fitted.bounds.upper >= row.highest;
            reasons.push_back(fmt::format(
                "AT BOUND: {} ended at its {} bound {:.6g}{}, and the other values depend on that; {}fix the parameter",
                name, at_lower ? "lower" : "upper", fitted.value, is_limit ? ", beyond which there is none" : "",
                is_limit ? "" : "widen the bound if it is not physiological, or "));
        } else if (status == Status::not_identifiable) {
            reasons.push_back(fmt::format(
                "NOT IDENTIFIABLE: around its fitted value the spectrum says less about {} than its bounds do; fix it, "
                "and compare fits with it fixed elsewhere",
                name));
        }
    }
}

void judge_model_error(const FitResult& result, std::vector<std::string>& reasons) {
    const double most = model_error_share * result.median_sigma;
    if (result.monte_carlo_error > most) {
        reasons.push_back(
            fmt::format("TOO FEW RAYS: the model's own error of {:.5f} exceeds half the noise of {:.5f}; set rays to "
                        "at least {:.0f}, or engine=solver, which has no random error",
                        result.monte_carlo_error, result.median_sigma,
                        static_cast<double>(result.configuration.rays) * (result.monte_carlo_error / most) *
                            (result.monte_carlo_error / most)));
    }
    if (result.emulator_error.value_or(0.0) > most) {
        reasons.push_back(
            fmt::format("EMULATOR TOO COARSE: its certified error of {:.5f} exceeds half the noise of {:.5f}; narrow "
                        "the bounds, or set engine=solver",
                        *result.emulator_error, result.median_sigma));
    }
}

void judge_end(const FitResult& result, std::vector<std::string>& reasons) {
    if (result.unfinished.empty()) return;
    reasons.push_back(fmt::format("INTERRUPTED before it had {}; run the fit again for the rest",
                                  fmt::join(result.unfinished, " and ")));
}

void judge_sampling(const FitResult& result, std::vector<std::string>& reasons) {
    if (result.profile && result.profile->better_minimum) {
        reasons.emplace_back(
            "BETTER MINIMUM met while profiling, and used: the solver had stopped in another valley; cross-check, and "
            "start elsewhere with --set");
    }
    if (!result.posterior) return;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const Marginal& marginal = result.posterior->marginals[i];
        const double effective = std::min(marginal.bulk_effective_size, marginal.tail_effective_size);
        if (marginal.r_hat < mixed && effective >= enough_draws) continue;
        reasons.push_back(
            fmt::format("CHAINS HAVE NOT MIXED in {}: R-hat {:.3f}, {:.0f} effective draws; fix parameters that trade "
                        "against each other, or use uncertainty=profile",
                        result.free[i].name, marginal.r_hat, effective));
    }
    if (result.posterior->divergences > 0) {
        reasons.push_back(
            fmt::format("DIVERGENCES: {} of {} steps of the sampler went astray, so that a corner of the posterior may "
                        "be missing; compare with uncertainty=profile",
                        result.posterior->divergences, result.posterior->draws.cols()));
    }
}

void judge_solvers(const FitResult& result, std::vector<std::string>& reasons) {
    for (const SolverAnswer& other : result.cross_check) {
        const double gain = result.cost - other.minimum.cost;
        const std::optional<double> difference = largest_difference_in_sigmas(result, other.minimum);
        const bool as_good = std::abs(gain) <= negligible_gain;
        if (gain > negligible_gain || (as_good && difference && *difference > different_sigmas)) {
            reasons.push_back(fmt::format(
                "SOLVERS DISAGREE: another solver ended at {} {:.6g} instead of {:.6g}{}, {:.2g} sigma away; set more "
                "starts, or fix parameters that trade against each other",
                cost_name(result), other.minimum.cost, result.cost, explained(result, " (cost: ", ")"),
                difference.value_or(0.0)));
        }
    }
}

}  // namespace

bool is_chi2_small(const FitResult& result) {
    return result.p_value && *result.p_value > 1.0 - improbable;
}

Diagnosis diagnose(const FitResult& result) {
    if (!result.answer.minimum.converged) {
        return {.verdict = Verdict::failed,
                .reasons = {
                    fmt::format("NOT CONVERGED: {}; try another solver, start elsewhere with --set, or fix parameters",
                                result.answer.minimum.termination)}};
    }
    std::vector<std::string> reasons;
    judge_spectrum(result, reasons);
    judge_misfit(result, reasons);
    judge_slow_residuals(result, reasons);
    judge_departure(result, reasons);
    judge_minima(result, reasons);
    judge_parameters(result, reasons);
    judge_assumptions(result, reasons);
    judge_model_error(result, reasons);
    judge_end(result, reasons);
    judge_sampling(result, reasons);
    judge_solvers(result, reasons);
    return {.verdict = reasons.empty() ? Verdict::consistent : Verdict::suspect, .reasons = std::move(reasons)};
}

}  // namespace skinfit
