#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/version.hpp"
#include "fit/report.hpp"
#include "validation/inverse_summary.hpp"

namespace skinfit {
namespace {

std::string coverage_words(const ParameterRecovery& row, UncertaintyMethod method) {
    const std::optional<Coverage>& coverage = row.coverage[static_cast<std::size_t>(method)];
    if (!coverage) return "-";
    if (coverage->identifiable == 0) return "- of 0         ";
    return fmt::format("{:.1f} % of {:<4} {:<5}", 100.0 * coverage->share(), coverage->identifiable,
                       row.coverage_passes(method).value_or(true) ? "" : "FAILS");
}

std::string rank_words(const ParameterRecovery& row) {
    if (!row.rank_p_value) return "-";
    return fmt::format("{:.2g}{}", *row.rank_p_value, row.ranks_pass() ? "" : " FAILS");
}

std::string agreement_line(const char* what, const Agreement& agreement) {
    return fmt::format("  {:<70}{:>6.2f} % (wanted: {:.1f} %){}\n", what, 100.0 * agreement.share(),
                       100.0 * agreement.wanted_share, agreement.passes() ? "" : "  FAILS");
}

Json agreement_json(const Agreement& agreement) {
    return {{"share", agreement.share()}, {"wanted", agreement.wanted_share}, {"passes", agreement.passes()}};
}

/// Per tenth of the spectra in order of the truth: how often the interval covers, where it is identifiable.
SheetLine coverage_line(const std::vector<RecoveredSpectrum>& spectra, std::size_t column, std::size_t method) {
    constexpr std::size_t tenths = 10;
    std::vector<std::size_t> order(spectra.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return spectra[k].parameters[column].truth; });
    SheetLine line{.label = std::string(uncertainty_names[method]), .x = {}, .y = {}};
    for (std::size_t tenth = 0; tenth < tenths; ++tenth) {
        std::size_t identifiable = 0;
        std::size_t covered = 0;
        for (std::size_t k = tenth * order.size() / tenths; k < (tenth + 1) * order.size() / tenths; ++k) {
            const RecoveredParameter& found = spectra[order[k]].parameters[column];
            const auto& interval = found.intervals[method];
            if (!interval || interval->status == Status::not_identifiable) continue;
            ++identifiable;
            if (interval->interval_95.lower <= found.truth && found.truth <= interval->interval_95.upper) ++covered;
        }
        if (identifiable == 0) continue;
        line.x.push_back((static_cast<double>(tenth) + 0.5) / tenths);
        line.y.push_back(100.0 * static_cast<double>(covered) / static_cast<double>(identifiable));
    }
    return line;
}

/// A stair over the bins.
SheetLine rank_line(const std::vector<std::size_t>& ranks) {
    SheetLine line{.label = "spectra", .x = {}, .y = {}};
    const auto bins = static_cast<double>(ranks.size());
    for (std::size_t bin = 0; bin < ranks.size(); ++bin) {
        for (const std::size_t edge : {bin, bin + 1}) {
            line.x.push_back(static_cast<double>(edge) / bins);
            line.y.push_back(static_cast<double>(ranks[bin]));
        }
    }
    return line;
}

SheetLine level(const char* label, double height) {
    return {.label = label, .x = {0.0, 1.0}, .y = {height, height}, .style = LineStyle::reference};
}

std::string interval_cells(const std::optional<RecoveredParameter::Interval>& interval) {
    if (!interval) return ",,,";
    return fmt::format(",{},{},{}", name_of(interval->status), interval->interval_95.lower,
                       interval->interval_95.upper);
}

}  // namespace

std::string recovery_csv(const std::vector<RecoveredSpectrum>& spectra, const std::vector<FreeParameter>& free) {
    std::string text = "spectrum,parameter,truth,estimate";
    for (const std::string_view method : uncertainty_names)
        text += fmt::format(",{0}_status,{0}_lower,{0}_upper", method);
    text += ",rank,converged,cost,lowest_cost,bobyqa_cost,bobyqa_sigmas_off,r_hat,divergences\n";
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        const RecoveredSpectrum& spectrum = spectra[k];
        for (std::size_t column = 0; column < free.size(); ++column) {
            const RecoveredParameter& found = spectrum.parameters[column];
            text += fmt::format("{},{},{},{}", k + 1, info(free[column].parameter).name, found.truth, found.estimate);
            for (const auto& interval : found.intervals) text += interval_cells(interval);
            text += fmt::format(",{},{},{},{},{},{},{},{}\n", found.rank ? std::to_string(*found.rank) : "",
                                spectrum.converged, spectrum.cost, spectrum.best_cost, spectrum.other_cost,
                                spectrum.other_sigmas ? fmt::format("{}", *spectrum.other_sigmas) : "",
                                spectrum.worst_r_hat, spectrum.divergences);
        }
    }
    return text;
}

std::string recovery_text(const RecoverySummary& summary) {
    std::string text = fmt::format(
        "verdict: {}\n{} spectra: {} not converged, {} posteriors not mixed, {} with divergences\n"
        "The fits know what made the spectra: their own model, its priors and its noise. This tests searches and\n"
        "intervals, not the model; `--simulate-by transport` does, by spectra of another physics.\n\n",
        passes(summary) ? "passes" : "FAILS", summary.spectra, summary.not_converged, summary.not_mixed,
        summary.diverged);
    text += agreement_line("searches that end within 1e-3 of the lowest cost known", summary.best_minimum);
    text += agreement_line("Ceres and BOBYQA end at the same cost, to 1e-6 of it", summary.solvers_cost);
    text += agreement_line("and at the same parameters, to 0.05 sigma", summary.solvers_parameters);
    text += fmt::format("\n{:<34}{:>12}{:>12}{:>24}{:>24}{:>24}{:>12}\n", "coverage of 95 % intervals", "bias", "RMSE",
                        uncertainty_names[0], uncertainty_names[1], uncertainty_names[2], "ranks: p");
    for (const ParameterRecovery& row : summary.parameters) {
        text += fmt::format("{:<34}{:>12.3g}{:>12.3g}", info(row.parameter).name, row.bias, row.root_mean_square_error);
        for (std::size_t method = 0; method < uncertainty_method_count; ++method) {
            text += fmt::format("{:>24}", coverage_words(row, static_cast<UncertaintyMethod>(method)));
        }
        text += fmt::format("{:>12}\n", rank_words(row));
    }
    return text +
           "Bias and RMSE where identifiable. Coverage is to lie within 93 to 97 %, and shares of searches at what is "
           "wanted, or\nwithin what chance makes of that: a rule fails where chance would do so in less than one study "
           "of 1000. Intervals by\ncovariance are those of the linearised model, and are not judged.\n"
           "Not mixed: chains of one posterior disagree; divergences: steps that went astray; ranks: p of the truth's "
           "ranks among the posterior's draws, all equally likely.\n";
}

Json recovery_json(const RecoverySummary& summary) {
    Json parameters;
    for (const ParameterRecovery& row : summary.parameters) {
        Json json = {{"bias", row.bias}, {"rmse", row.root_mean_square_error}};
        for (std::size_t method = 0; method < uncertainty_method_count; ++method) {
            const std::optional<Coverage>& coverage = row.coverage[method];
            if (!coverage) continue;
            const std::optional<bool> passes = row.coverage_passes(static_cast<UncertaintyMethod>(method));
            json["coverage"][uncertainty_names[method]] = {
                {"identifiable", coverage->identifiable},
                {"share", coverage->identifiable > 0 ? Json(coverage->share()) : Json()},
                {"passes", passes ? Json(*passes) : Json()}};
        }
        if (row.rank_p_value) json["ranks"] = {{"p_value", *row.rank_p_value}, {"histogram", row.ranks}};
        parameters[std::string(info(row.parameter).name)] = json;
    }
    return {{"version", version},
            {"passes", passes(summary)},
            {"spectra", summary.spectra},
            {"not_converged", summary.not_converged},
            {"not_mixed", summary.not_mixed},
            {"diverged", summary.diverged},
            {"best_minimum", agreement_json(summary.best_minimum)},
            {"solvers_cost", agreement_json(summary.solvers_cost)},
            {"solvers_parameters", agreement_json(summary.solvers_parameters)},
            {"parameters", parameters}};
}

PlotSheet recovery_sheet(const std::vector<RecoveredSpectrum>& spectra, const RecoverySummary& summary) {
    SheetRow ranks{.x_label = "rank of the truth among draws of the posterior, as a share",
                   .y_label = "spectra",
                   .x_low = 0.0,
                   .x_high = 1.0,
                   .panels = {}};
    SheetRow coverage{.x_label = "spectra in order of the truth, as a share",
                      .y_label = "coverage of 95 % intervals (%)",
                      .x_low = 0.0,
                      .x_high = 1.0,
                      .panels = {}};
    bool is_ranked = true;
    for (std::size_t column = 0; column < summary.parameters.size(); ++column) {
        const ParameterRecovery& row = summary.parameters[column];
        const std::string name(info(row.parameter).name);
        is_ranked = is_ranked && row.rank_p_value.has_value();
        const double even = static_cast<double>(summary.spectra) / static_cast<double>(row.ranks.size());
        ranks.panels.push_back(
            {.title = name, .lines = {rank_line(row.ranks), level("uniform", even)}, .swatches = {}});
        SheetPanel panel{.title = name, .lines = {}, .swatches = {}};
        for (std::size_t method = 0; method < uncertainty_method_count; ++method) {
            SheetLine line = coverage_line(spectra, column, method);
            if (!line.x.empty()) panel.lines.push_back(std::move(line));
        }
        panel.lines.push_back(level("95 %", 95.0));
        coverage.panels.push_back(std::move(panel));
    }
    PlotSheet sheet{.title = fmt::format("recovery of {} synthetic spectra", summary.spectra), .rows = {}};
    if (is_ranked) sheet.rows.push_back(std::move(ranks));
    sheet.rows.push_back(std::move(coverage));
    return sheet;
}

}  // namespace skinfit
