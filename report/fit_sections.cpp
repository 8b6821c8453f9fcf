#include "report/fit_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/configuration_json.hpp"
#include "fit/model_split.hpp"
#include "fit/parameter_words.hpp"
#include "fit/report.hpp"
#include "fit/tissue.hpp"
#include "report/fit_picture.hpp"
#include "report/html_figure.hpp"
#include "report/html_table.hpp"
#include "report/interval_picture.hpp"

namespace skinfit {
namespace {

Html misfit_list(const FitResult& result) {
    std::vector<std::pair<std::string, Html>> items = {{"judged against", escaped(assumed_words(result))},
                                                       {"misfit", escaped(misfit_words(result))}};
    if (result.slow_residuals_p_value) {
        items.emplace_back("slow residuals", escaped(fmt::format("p = {:.2g}", *result.slow_residuals_p_value)));
    }
    if (has_own_cost(result)) {
        items.emplace_back("minimised",
                           escaped(fmt::format("cost {:.2f}, which is {}", result.cost, cost_words(result))));
    }
    for (const std::string& prior : result.priors) items.emplace_back("prior", escaped(prior));
    items.emplace_back("computation", escaped(model_error_words(result)));
    return definition_list(items);
}

Html spectra_table(const FitResult& result) {
    HtmlTable table{.caption = "Each spectrum's part of the misfit",
                    .columns = {{.name = "spectrum", .cells = Cells::text},
                                {.name = "wavelengths"},
                                {.name = "rmse"},
                                {.name = "chi2"},
                                {.name = "noise", .cells = Cells::text}},
                    .rows = {}};
    for (const FittedSpectrum& each : result.spectra) {
        table.rows.push_back({escaped(each.name), escaped(fmt::format("{}", each.wavelength_nm.size())),
                              escaped(fmt::format("{:.5f}", each.rmse)), escaped(fmt::format("{:.2f}", each.chi2)),
                              escaped(each.sigma_source)});
    }
    return html_table(table);
}

std::string band_words(const FitResult& result) {
    return result.posterior ? "the 2.5 % to 97.5 % quantiles of the readings of 400 draws of the posterior"
                            : "1.96 standard deviations of the reading, from the covariance of the free parameters by "
                              "the linearised model, those at a bound held";
}

Html fixed_table(const FitResult& result) {
    HtmlTable table{.caption = "",
                    .columns = {{.name = "fixed parameter", .cells = Cells::text},
                                {.name = "value"},
                                {.name = "unit", .cells = Cells::text}},
                    .rows = {}};
    for (const FittedParameter& fixed : result.fixed) {
        const std::string_view unit = info(fixed.parameter).unit;
        table.rows.push_back(
            {escaped(fixed.name), escaped(fmt::format("{:.6g}", fixed.value)), escaped(unit.empty() ? "-" : unit)});
    }
    return html_table(table);
}

std::string healthy_words(Parameter parameter) {
    const std::optional<PhysiologicalPrior> known = known_of(parameter);
    return known && known->healthy ? std::string(known->source) : "-";
}

Html free_table(const FitResult& result) {
    const bool draws = result.monte_carlo_error > 0.0;
    HtmlTable table{.caption = "Free parameters",
                    .columns = {{.name = "parameter", .cells = Cells::text},
                                {.name = "value"},
                                {.name = "+/- 1 sigma"},
                                {.name = "95 % interval"},
                                {.name = "unit", .cells = Cells::text}},
                    .rows = {}};
    const bool has_remarks = std::ranges::any_of(
        result.free, [](const FittedParameter& each) { return !parameter_words(each).remark.empty(); });
    if (draws) table.columns.push_back({.name = "Monte Carlo"});
    if (has_remarks) table.columns.push_back({.name = "remark", .cells = Cells::text});
    table.columns.push_back({.name = "healthy skin", .cells = Cells::text});
    for (const FittedParameter& free : result.free) {
        const ParameterWords words = parameter_words(free);
        std::vector<Html> row = {escaped(free.name), escaped(words.value), escaped(words.sigma),
                                 escaped(words.interval_95), escaped(words.unit)};
        if (draws) row.push_back(escaped(words.monte_carlo));
        if (has_remarks) row.push_back(escaped(words.remark));
        row.push_back(escaped(healthy_words(free.parameter)));
        table.rows.push_back(std::move(row));
    }
    return html_table(table);
}

Html other_assumptions_table(const OtherAssumptions& others) {
    HtmlTable table{.caption = "What other assumptions change",
                    .columns = {{.name = "assumption", .cells = Cells::text}, {.name = "bands left out"}},
                    .rows = {}};
    const auto row = [](std::string_view assumption, double error) {
        return std::vector<Html>{escaped(assumption), escaped(fmt::format("{:.4f}", error))};
    };
    std::vector<Html> fitted = row("as fitted", others.left_out_rmse);
    for (const OtherAssumptions::Answer& answer : others.answers) {
        table.columns.push_back({.name = answer.name});
        fitted.push_back(escaped(fmt::format("{:.3g}", answer.value)));
    }
    table.rows.push_back(std::move(fitted));
    for (const OtherAssumptions::Alternative& each : others.alternatives) {
        table.rows.push_back(row(each.assumption, each.left_out_rmse));
        for (const double value : each.values) {
            table.rows.back().push_back(escaped(std::isfinite(value) ? fmt::format("{:.3g}", value) : "-"));
        }
    }
    return html_table(table);
}

/// What does not depend on how the model divides the skin, and where its division is its own.
Html tissue_part(const FitResult& result) {
    const std::vector<TissueEstimate> estimates = tissue_estimates(result);
    if (estimates.empty()) return {};
    HtmlTable table{.caption = "In the tissue",
                    .columns = {{.name = "quantity", .cells = Cells::text},
                                {.name = "value"},
                                {.name = "95 % interval"},
                                {.name = "unit", .cells = Cells::text}},
                    .rows = {}};
    for (const TissueEstimate& each : estimates) {
        const std::string_view unit = each.quantity->unit;
        table.rows.push_back({escaped(std::string(each.quantity->name)), escaped(fmt::format("{:.3g}", each.value)),
                              escaped(interval_words(each)), escaped(unit.empty() ? "-" : unit)});
    }
    Html part = html_table(table);
    if (const std::string words = calibration_words(estimates); !words.empty()) part += paragraph(words + ".");
    for (const ModelSplit& split : model_splits(result)) part += paragraph(in_words(split));
    return part;
}

}  // namespace

HtmlSection spectrum_section(const FitResult& result) {
    HtmlSection section{.title = result.spectra.size() == 1 ? "Spectrum" : "Spectra", .body = {}};
    for (const FittedSpectrum& each : result.spectra) {
        section.body += html_figure(
            {.picture = fit_picture({&each, 1}, "fit.svg"),
             .alternative = fmt::format("Measured and modelled {} of {} from {:g} to {:g} nm; root mean square of the "
                                        "residuals {:.5f}",
                                        quantity_names.at(static_cast<std::size_t>(each.configuration.quantity)),
                                        each.name, each.wavelength_nm.front(), each.wavelength_nm.back(), each.rmse),
             .caption = fmt::format("{}: {}. Band of the model: {}. Noise: {}.", each.name,
                                    instrument_words(each.configuration), band_words(result), each.sigma_source)});
    }
    if (result.spectra.size() > 1) section.body += spectra_table(result);
    section.body += misfit_list(result);
    return section;
}

HtmlSection parameter_section(const FitResult& result) {
    HtmlSection section{.title = "Parameters", .body = free_table(result) + tissue_part(result), .starts_page = true};
    section.body += paragraph(
        "Sigma is the standard deviation that the measurement's noise causes where the model is right; Monte Carlo the "
        "further error from the finite number of simulated rays. A parameter at a bound, or one that the spectrum does "
        "not determine, has an interval but no sigma.");
    section.body += html_figure(
        {.picture = interval_picture(result.free),
         .alternative = "Values and 95 % intervals of the table above, drawn over the ranges of healthy skin",
         .caption = "Each parameter over an axis of its own: the range published for healthy skin where there is one "
                    "(sources in the table), else the bounds of the fit."});
    if (result.other_assumptions) {
        section.body += other_assumptions_table(*result.other_assumptions);
        section.body += paragraph(
            "Bands left out: root mean square error with which bands of 30 nm follow from the rest of the spectrum. An "
            "answer that leaves its interval under an assumption that predicts them better by a fifth makes the fit "
            "suspect.");
    }
    section.body += folded(fmt::format("{} parameters held fixed", result.fixed.size()), fixed_table(result));
    return section;
}

}  // namespace skinfit
