#include "fit/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skinfit {
namespace {

constexpr double improbable = 1e-3;
constexpr double monte_carlo_share = 0.5;  // of the noise
constexpr double better_chi2 = 1e-3;
constexpr double different_sigmas = 0.1;
constexpr double mixed = 1.01;        // R-hat, [VEHTARI21]
constexpr double enough_draws = 400;  // effective, [VEHTARI21]

void judge_misfit(const FitResult& result, std::vector<std::string>& reasons) {
    if (!result.p_value) {
        reasons.emplace_back(
            "NO DEGREES OF FREEDOM: as many parameters as wavelengths, so nothing tests the model; measure more "
            "wavelengths or fix parameters");
    } else if (*result.p_value < improbable) {
        reasons.push_back(
            fmt::format("MISFIT beyond the noise: chi2 {:.1f} for {} degrees of freedom (p = {:.1g}), rmse {:.4f} "
                        "against a noise of "
                        "{:.4f}; check geometry and specular, free scale or other parameters, or state a larger noise",
                        result.chi2, result.degrees_of_freedom, *result.p_value, result.rmse, result.median_sigma));
    }
}

void judge_parameters(const FitResult& result, std::vector<std::string>& reasons) {
    for (const FittedParameter& fitted : result.parameters) {
        const std::string_view name = info(fitted.parameter).name;
        const Status status = fitted.uncertainty.status;
        if (status == Status::at_lower_bound || status == Status::at_upper_bound) {
            reasons.push_back(fmt::format(
                "AT BOUND: {} ended at its {} bound {:.6g}, and the other values depend on that; widen the bound if it "
                "is not physiological, or fix the parameter",
                name, status == Status::at_lower_bound ? "lower" : "upper", fitted.value));
        } else if (status == Status::not_identifiable) {
            reasons.push_back(fmt::format(
                "NOT IDENTIFIABLE: around its fitted value the spectrum says less about {} than its bounds do; fix it, "
                "and compare fits with it fixed elsewhere",
                name));
        }
    }
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
                        info(result.free[i]).name, marginal.r_hat, effective));
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
        const double gain = result.chi2 - other.minimum.chi2;
        const std::optional<double> difference = largest_difference_in_sigmas(result, other.minimum);
        if (gain > better_chi2 || (difference && *difference > different_sigmas)) {
            reasons.push_back(fmt::format(
                "SOLVERS DISAGREE: another solver ended at chi2 {:.6g} instead of {:.6g}, {:.2g} sigma away; start "
                "elsewhere with --set, or fix parameters that trade against each other",
                other.minimum.chi2, result.chi2, difference.value_or(0.0)));
        }
    }
}

}  // namespace

Diagnosis diagnose(const FitResult& result) {
    if (!result.answer.minimum.converged) {
        return {.verdict = Verdict::failed,
                .reasons = {fmt::format("NOT CONVERGED: {}; start elsewhere with --set, or fix parameters",
                                        result.answer.minimum.termination)}};
    }
    std::vector<std::string> reasons;
    judge_misfit(result, reasons);
    judge_parameters(result, reasons);
    if (result.monte_carlo_error > monte_carlo_share * result.median_sigma) {
        reasons.push_back(
            fmt::format("TOO FEW RAYS: the model's own error of {:.5f} exceeds half the noise of {:.5f}; set rays to "
                        "at least {:.0f}",
                        result.monte_carlo_error, result.median_sigma,
                        static_cast<double>(result.configuration.rays) *
                            (result.monte_carlo_error / result.median_sigma / monte_carlo_share) *
                            (result.monte_carlo_error / result.median_sigma / monte_carlo_share)));
    }
    judge_sampling(result, reasons);
    judge_solvers(result, reasons);
    return {.verdict = reasons.empty() ? Verdict::trustworthy : Verdict::suspect, .reasons = std::move(reasons)};
}

}  // namespace skinfit
