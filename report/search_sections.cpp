#include <fmt/format.h>

#include "fit/configuration_json.hpp"
#include "fit/report.hpp"
#include "report/fit_sections.hpp"
#include "report/html_table.hpp"

namespace skinfit {
namespace {

std::string away(const FitResult& result, const Minimum& minimum) {
    const std::optional<double> difference = largest_difference_in_sigmas(result, minimum);
    return difference ? fmt::format("{:.2g}", *difference) : "-";
}

std::string end_of(const Minimum& minimum) {
    if (minimum.converged) return "converged";
    return minimum.termination == out_of_evaluations ? "stopped: out of evaluations" : "NOT CONVERGED";
}

/// A column for each minimum: parameters are many, minima few.
Html minima_table(const FitResult& result) {
    HtmlTable table{
        .caption = "Minima, best first; the first is the answer",
        .columns = {{.name = "minimum", .cells = Cells::text}},
        .rows = {
            {escaped(cost_name(result))}, {escaped("searches")}, {escaped("largest sigmas off")}, {escaped("end")}}};
    for (const FittedParameter& free : result.free) table.rows.push_back({escaped(free.name)});
    for (std::size_t i = 0; i < result.searches.minima.size(); ++i) {
        const Minimum& minimum = result.searches.minima[i].minimum;
        table.columns.push_back({.name = fmt::format("{}", i + 1)});
        std::vector<std::string> cells = {fmt::format("{:.8g}", minimum.cost),
                                          fmt::format("{}", result.searches.minima[i].searches), away(result, minimum),
                                          end_of(minimum)};
        for (const double value : minimum.values) cells.push_back(fmt::format("{:.5g}", value));
        for (std::size_t row = 0; row < cells.size(); ++row) table.rows[row].push_back(escaped(cells[row]));
    }
    return html_table(table);
}

std::vector<Html> solver_row(const FitResult& result, const SolverAnswer& answer) {
    Configuration named;
    named.solver = answer.solver;
    return {escaped(setting_word(to_json(named), "solver")), escaped(fmt::format("{:.8g}", answer.minimum.cost)),
            escaped(away(result, answer.minimum)), escaped(fmt::format("{}", answer.minimum.evaluations)),
            escaped(end_of(answer.minimum))};
}

Html cross_check_table(const FitResult& result) {
    HtmlTable table{.caption = "Other solvers on the same problem",
                    .columns = {{.name = "solver", .cells = Cells::text},
                                {.name = std::string(cost_name(result))},
                                {.name = "largest sigmas off"},
                                {.name = "evaluations"},
                                {.name = "end", .cells = Cells::text}},
                    .rows = {solver_row(result, result.answer)}};
    for (const SolverAnswer& other : result.cross_check) table.rows.push_back(solver_row(result, other));
    return html_table(table);
}

}  // namespace

HtmlSection findings_section(const FitResult& result) {
    HtmlSection section{.title = "Quality of the data", .body = {}};
    if (result.findings.empty()) {
        section.body = paragraph("Nothing was found wrong with the data before the fit.");
        return section;
    }
    HtmlTable table{.caption = "Findings, made before the fit",
                    .columns = {{.name = "finding", .cells = Cells::text},
                                {.name = "severity", .cells = Cells::text},
                                {.name = "spectrum", .cells = Cells::text},
                                {.name = "what", .cells = Cells::text},
                                {.name = "remedy", .cells = Cells::text}},
                    .rows = {}};
    for (const Finding& finding : result.findings) {
        table.rows.push_back({escaped(finding.name),
                              escaped(finding.severity == Severity::warning ? "WARNING" : name_of(finding.severity)),
                              escaped(finding.spectrum), escaped(finding.message), escaped(finding.remedy)});
    }
    section.body = html_table(table);
    return section;
}

HtmlSection minima_section(const FitResult& result) {
    HtmlSection section{.title = "Searches", .body = paragraph(fmt::format("{}.", search_words(result)))};
    if (has_own_cost(result)) section.body += paragraph(fmt::format("cost: {}.", cost_words(result)));
    section.body += minima_table(result);
    if (!result.cross_check.empty()) section.body += cross_check_table(result);
    return section;
}

}  // namespace skinfit
