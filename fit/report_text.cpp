#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/diagnosis.hpp"
#include "fit/inspection.hpp"
#include "fit/measurement.hpp"
#include "fit/model_split.hpp"
#include "fit/parameter_words.hpp"
#include "fit/report.hpp"
#include "fit/tissue.hpp"

namespace skinfit {
namespace {

std::string parameter_row(const FittedParameter& fitted) {
    const ParameterWords words = parameter_words(fitted);
    return fmt::format("  {:<33} {:>12} {:>11} {:>11}   {:<22}{}{}\n", fitted.name, words.value, words.sigma,
                       words.monte_carlo, words.interval_95, words.unit,
                       words.remark.empty() ? "" : "  " + words.remark);
}

std::string parameter_table_text(const FitResult& result) {
    std::string text = fmt::format("  {:<33} {:>12} {:>11} {:>11}   {:<22}{}\n", "free parameter", "value",
                                   "+/- 1 sigma", "Monte Carlo", "95 % interval", "unit");
    for (const FittedParameter& fitted : result.free) text += parameter_row(fitted);
    return text;
}

/// What does not depend on how the model divides the skin.
std::string tissue_text(const FitResult& result) {
    const std::vector<TissueEstimate> estimates = tissue_estimates(result);
    if (estimates.empty()) return "";
    std::string text = fmt::format("  {:<33} {:>12}   {:<22}{}\n", "in the tissue", "value", "95 % interval", "unit");
    for (const TissueEstimate& each : estimates) {
        text += fmt::format("  {:<33} {:>12.3g}   {:<22}{}\n", each.quantity->name, each.value, interval_words(each),
                            each.quantity->unit.empty() ? "-" : each.quantity->unit);
    }
    if (const std::string words = calibration_words(estimates); !words.empty()) text += fmt::format("  {}\n", words);
    for (const ModelSplit& split : model_splits(result)) text += fmt::format("  {}\n", in_words(split));
    return text + "\n";
}

std::string fixed_text(const FitResult& result) {
    std::string text = "fixed:";
    for (const FittedParameter& fitted : result.fixed) {
        const std::string item = fmt::format(" {}={:.6g}", fitted.name, fitted.value);
        const std::size_t line_start = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
        constexpr std::size_t line_length = 110;
        if (text.size() + item.size() - line_start > line_length) text += "\n      ";
        text += item;
    }
    return text + "\n";
}

std::string correlation_text(const FitResult& result) {
    constexpr double strong = 0.9;
    std::string text;
    for (Eigen::Index a = 0; a < result.correlation.rows(); ++a) {
        for (Eigen::Index b = a + 1; b < result.correlation.cols(); ++b) {
            if (std::abs(result.correlation(a, b)) <= strong) continue;
            text += fmt::format("  {:+.3f}  {} with {}\n", result.correlation(a, b),
                                result.free[static_cast<std::size_t>(a)].name,
                                result.free[static_cast<std::size_t>(b)].name);
        }
    }
    return text.empty() ? "correlations above 0.9: none\n" : "correlations above 0.9:\n" + text;
}

std::string away(const FitResult& result, const Minimum& minimum) {
    const std::optional<double> difference = largest_difference_in_sigmas(result, minimum);
    return difference ? fmt::format("{:.2g}", *difference) : "-";
}

std::string solver_line(const FitResult& result, const SolverAnswer& answer) {
    Configuration named;
    named.solver = answer.solver;
    return fmt::format("  {:<8}{:>14.8g}{:>20}{:>14}{:>10.2f}  {}\n", to_json(named)["solver"].get<std::string>(),
                       answer.minimum.cost, away(result, answer.minimum), answer.minimum.evaluations, answer.seconds,
                       answer.minimum.converged                           ? "converged"
                       : answer.minimum.termination == out_of_evaluations ? "stopped: out of evaluations"
                                                                          : "NOT CONVERGED");
}

std::string cross_check_text(const FitResult& result) {
    if (result.cross_check.empty()) return "";
    std::string text = fmt::format("cross-check:\n  {:<8}{:>14}{:>20}{:>14}{:>10}\n", "solver", cost_name(result),
                                   "largest sigmas off", "evaluations", "seconds");
    text += solver_line(result, result.answer);
    for (const SolverAnswer& other : result.cross_check) text += solver_line(result, other);
    return text;
}

std::string minima_text(const FitResult& result) {
    const std::vector<DistinctMinimum>& minima = result.searches.minima;
    if (minima.empty()) return "";
    if (minima.size() == 1) return fmt::format("searches: {}\n", search_words(result));
    std::string text = fmt::format("searches: {}:\n  {:<14}{:>10}{:>20}\n", search_words(result), cost_name(result),
                                   "searches", "largest sigmas off");
    for (const DistinctMinimum& each : minima) {
        text += fmt::format("  {:<14.8g}{:>10}{:>20}{}\n", each.minimum.cost, each.searches, away(result, each.minimum),
                            each.minimum.converged ? "" : "  NOT CONVERGED");
    }
    return text;
}

/// What was minimised, where it was not chi2 alone.
std::string cost_text(const FitResult& result) {
    std::string text;
    if (has_own_cost(result)) {
        text += fmt::format("minimised: cost {:.2f}, which is {}\n", result.cost, cost_words(result));
    }
    for (const std::string& prior : result.priors) text += fmt::format("prior: {}\n", prior);
    return text;
}

std::string other_assumptions_text(const FitResult& result) {
    if (!result.other_assumptions) return "";
    const OtherAssumptions& others = *result.other_assumptions;
    const auto row = [&](std::string_view assumption, double error, const auto& value_of) {
        std::string text = fmt::format("  {:<33} {:>12.4f}", assumption, error);
        for (std::size_t i = 0; i < others.answers.size(); ++i) {
            const double value = value_of(i);
            const std::string shown = std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
            text += fmt::format("  {:>{}}", shown, others.answers[i].name.size());
        }
        return text + "\n";
    };
    std::string text = fmt::format("what other assumptions change:\n  {:<33} {:>12}", "assumption", "left out");
    for (const OtherAssumptions::Answer& answer : others.answers) text += "  " + answer.name;
    text += "\n" + row("as fitted", others.left_out_rmse, [&](std::size_t i) { return others.answers[i].value; });
    for (const OtherAssumptions::Alternative& each : others.alternatives) {
        text += row(each.assumption, each.left_out_rmse, [&](std::size_t i) { return each.values[i]; });
    }
    return text + "  left out: error in bands of 30 nm that the fit has not seen\n";
}

std::string model_text(const FitResult& result) {
    const ResolvedConfiguration& configuration = result.spectra.front().configuration;
    const Json json = to_json(configuration);
    const bool draws_rays = configuration.engine == Engine::paths || configuration.engine == Engine::walk;
    const std::string rays = draws_rays ? fmt::format(", {} rays", setting_word(json, "rays")) : "";
    std::string text =
        fmt::format("model: preset {}, edition {}, engine {}{}, seed {}; {} layers on base {}\n",
                    setting_word(json, "preset"), setting_word(json, "edition"), setting_word(json, "engine"), rays,
                    setting_word(json, "seed"), setting_word(json, "layers"), setting_word(json, "base"));
    if (configuration.preset == Preset::skin) {
        text +=
            "known error of preset skin: on skin of another physics oxygen saturation is off by 0.06 to 0.09 on "
            "average; see docs/skin.md\n";
    }
    if (result.spectra.size() == 1) text += fmt::format("instrument: {}\n", instrument_words(configuration));
    return text + fmt::format("skinfit {}, research software, not a medical device\n", version);
}

std::string title_text(const FitResult& result) {
    if (result.spectra.size() == 1) {
        return fmt::format("{} ({})\n", result.spectra.front().name, result.spectra.front().source);
    }
    std::string text = fmt::format("{} spectra, explained together\n", result.spectra.size());
    for (std::size_t k = 0; k < result.spectra.size(); ++k) {
        const FittedSpectrum& spectrum = result.spectra[k];
        text += fmt::format("  [{}] {} ({}): {}\n", k + 1, spectrum.name, spectrum.source,
                            instrument_words(spectrum.configuration));
    }
    return text;
}

std::string readings_text(const FittedSpectrum& spectrum) {
    return fmt::format("wavelengths: {} from {:g} to {:g} nm; values read as {}\n", spectrum.wavelength_nm.size(),
                       spectrum.wavelength_nm.front(), spectrum.wavelength_nm.back(), spectrum.unit_rule);
}

/// Wavelengths; of several spectra with their noises and misfits.
std::string spectra_text(const FitResult& result) {
    if (result.spectra.size() == 1) {
        return readings_text(result.spectra.front()) + model_error_words(result) + "\n";
    }
    std::string text;
    for (std::size_t k = 0; k < result.spectra.size(); ++k) {
        const FittedSpectrum& spectrum = result.spectra[k];
        text += fmt::format("  [{}] rmse {:.5f}, chi2 {:.2f}; noise: {}; {}", k + 1, spectrum.rmse, spectrum.chi2,
                            spectrum.sigma_source, readings_text(spectrum));
    }
    return text + model_error_words(result) + "\n";
}

}  // namespace

std::string misfit_words(const FitResult& result) {
    std::string text = fmt::format("rmse {:.5f}", result.rmse);
    if (result.configuration.discrepancy) {
        text += fmt::format(" ({:.5f} without what the discrepancy takes)", result.unexplained_rmse);
    }
    text += fmt::format(", chi2 {:.2f} for {:.3g} degrees of freedom{}", result.chi2, result.degrees_of_freedom,
                        result.p_value ? fmt::format(" (p = {:.2g})", *result.p_value) : "");
    if (!is_chi2_small(result)) return text;
    return text +
           ", improbably little: noise and discrepancy are stated larger than the residuals are, so intervals are wide";
}

std::string assumed_words(const FitResult& result) {
    const std::optional<Discrepancy>& discrepancy = result.configuration.discrepancy;
    const std::string noise = result.spectra.size() == 1 ? result.spectra.front().sigma_source : "of each spectrum";
    return fmt::format(
        "noise {}; the model's own departure (discrepancy) {}", noise,
        discrepancy ? fmt::format("{:g} over {:g} nm", discrepancy->sigma, discrepancy->length_nm) : "none");
}

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::consistent:
            return "consistent";
        case Verdict::suspect:
            return "suspect";
        default:
            return "failed";
    }
}

std::string_view name_of(Status status) {
    switch (status) {
        case Status::free:
            return "free";
        case Status::fixed:
            return "fixed";
        case Status::at_lower_bound:
            return "at_lower_bound";
        case Status::at_upper_bound:
            return "at_upper_bound";
        default:
            return "not_identifiable";
    }
}

std::string setting_word(const Json& configuration, const char* key) {
    const Json& value = configuration[key];
    if (value.is_string()) return value.get<std::string>();
    return value.is_number_float() ? fmt::format("{:g}", value.get<double>()) : value.dump();
}

std::string model_error_words(const FitResult& result) {
    if (result.solver_error) return fmt::format("stated error of the angular solver: {:.1e}", *result.solver_error);
    if (!result.emulator_error) {
        return fmt::format("Monte Carlo error of the model: {}", monte_carlo_words(result.monte_carlo_error));
    }
    return fmt::format("certified error of the emulator: {:.1e}", *result.emulator_error);
}

std::string search_words(const FitResult& result) {
    const Searches& searches = result.searches;
    // One at which no search ended was met by a profile.
    const auto ended_at =
        std::ranges::count_if(searches.minima, [](const DistinctMinimum& m) { return m.searches > 0; });
    const std::string minima = fmt::format("{} {}", ended_at, ended_at == 1 ? "minimum" : "minima");
    std::string text = fmt::format("{} start{}", searches.starts, searches.starts == 1 ? "" : "s");
    if (searches.finished < searches.rough_minima) {
        text += fmt::format(", {} minima; the best {} were finished, and ended at {}", searches.rough_minima,
                            searches.finished, minima);
    } else {
        text += fmt::format(", which ended at {}", minima);
    }
    if (static_cast<std::size_t>(ended_at) < searches.minima.size()) text += "; profiling met one more";
    return text;
}

std::string instrument_words(const ResolvedConfiguration& configuration) {
    const Json json = to_json(configuration);
    const std::optional<Bandpass> band = bandpass_of(configuration);
    return fmt::format(
        "{}, incidence {} deg, specular {}{}{}", setting_word(json, "quantity"), setting_word(json, "incidence_deg"),
        setting_word(json, "specular"),
        configuration.viewing_cone_deg ? fmt::format(", viewing cone {:g} deg", *configuration.viewing_cone_deg) : "",
        band ? fmt::format(", bandpass {} {:g} nm", setting_word(json, "bandpass_shape"), band->width_nm) : "");
}

std::string text_report(const FitResult& result) {
    std::string verdict(name_of(result.verdict));
    if (result.verdict != Verdict::consistent) std::ranges::transform(verdict, verdict.begin(), ::toupper);
    std::string text = title_text(result) + fmt::format("verdict: {}\n", verdict);
    for (const std::string& reason : result.reasons) text += fmt::format("  - {}\n", reason);
    text += fmt::format("  judged against: {}\n", assumed_words(result));
    if (const std::string words = prior_words(result); !words.empty()) text += fmt::format("  {}\n", words);
    if (!result.findings.empty()) text += findings_text(result.findings, result.spectra.size());
    text += fmt::format("\n{}\n{}", parameter_table_text(result), tissue_text(result));
    text += fmt::format("misfit: {}\n", misfit_words(result)) + other_assumptions_text(result);
    text += cost_text(result) + spectra_text(result);
    return text + correlation_text(result) + uncertainty_text(result) + minima_text(result) + cross_check_text(result) +
           fixed_text(result) + model_text(result);
}

}  // namespace skinfit
