#include "report/fit_report.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/parameter_words.hpp"
#include "fit/report.hpp"
#include "model/table.hpp"
#include "report/fit_sections.hpp"
#include "report/html_page.hpp"
#include "report/html_table.hpp"
#include "report/references.hpp"

namespace skinfit {
namespace {

Html summary(const FitResult& result) {
    Html text = element("p", escaped("Verdict: ") + badge(name_of(result.verdict))) + Html{"\n"};
    std::vector<Html> reasons;
    for (const std::string& reason : result.reasons) reasons.push_back(escaped(reason));
    text += bullet_list(reasons);
    if (reasons.empty()) text += paragraph("Nothing speaks against the fit.");
    if (const std::string words = prior_words(result); !words.empty()) text += paragraph(words + ".");
    return text;
}

Html spectra_list(const FitResult& result) {
    HtmlTable table{.caption = "Spectra",
                    .columns = {{.name = "name", .cells = Cells::text},
                                {.name = "file", .cells = Cells::text},
                                {.name = "instrument", .cells = Cells::text},
                                {.name = "values read as", .cells = Cells::text},
                                {.name = "noise", .cells = Cells::text}},
                    .rows = {}};
    for (const FittedSpectrum& each : result.spectra) {
        table.rows.push_back({escaped(each.name), escaped(each.source), escaped(instrument_words(each.configuration)),
                              escaped(each.unit_rule), escaped(each.sigma_source)});
    }
    return html_table(table);
}

Html tables_list() {
    constexpr std::array<std::string_view, 8> names = {"hemoglobin", "bilirubin",    "beta_carotene",
                                                       "eumelanin",  "pheomelanin",  "forward_scattering",
                                                       "cie_d65",    "cie_observers"};
    HtmlTable table{.caption = "Measured tables of the model",
                    .columns = {{.name = "table", .cells = Cells::text},
                                {.name = "what", .cells = Cells::text},
                                {.name = "unit", .cells = Cells::text},
                                {.name = "source", .cells = Cells::text}},
                    .rows = {}};
    for (const std::string_view name : names) {
        const Table& each = embedded_table(name);
        table.rows.push_back({escaped(each.name), escaped(each.quantity), escaped(each.unit), escaped(each.source)});
    }
    return html_table(table);
}

HtmlSection provenance_section(const FitResult& result, const ReportOrigin& origin) {
    const ResolvedConfiguration& configuration = result.spectra.front().configuration;
    const Json json = to_json(configuration);
    std::vector<std::pair<std::string, Html>> items = {{"program", escaped(fmt::format("skinfit {}", version))}};
    if (!origin.command_line.empty()) items.emplace_back("command", element("code", escaped(origin.command_line)));
    if (!origin.other.empty()) items.emplace_back("made by", escaped(origin.other));
    items.emplace_back(
        "model", escaped(fmt::format("BioSpec [KA04], edition {}, {} layers on base {}", setting_word(json, "edition"),
                                     setting_word(json, "layers"), setting_word(json, "base"))));
    items.emplace_back("engine", escaped(setting_word(json, "engine")));
    if (configuration.engine == Engine::paths) items.emplace_back("rays", escaped(setting_word(json, "rays")));
    items.emplace_back("seed", escaped(setting_word(json, "seed")));
    items.emplace_back("solver", escaped(setting_word(json, "solver")));
    HtmlSection section{
        .title = "Provenance", .body = definition_list(items) + spectra_list(result), .starts_page = true};
    section.body += tables_list();
    section.body += paragraph(
        "The block below is the report for programs, with every number in full and the whole configuration. Saved as "
        "result.json, it repeats the fit: skinfit fit FILE --config result.json.");
    const std::string text = json_report(result).dump(2, ' ', false, Json::error_handler_t::replace);
    section.body += folded_text("Result and configuration as JSON", text);
    return section;
}

HtmlSection reference_section(const std::vector<HtmlSection>& sections) {
    Html all;
    for (const HtmlSection& each : sections) all += each.body;
    std::vector<std::pair<std::string, Html>> entries;
    for (const auto& [key, reference] : cited_references(all.markup)) {
        entries.emplace_back("[" + key + "]", escaped(reference));
    }
    return {.title = "References", .body = definition_list(entries)};
}

std::string title(const FitResult& result) {
    if (result.spectra.size() == 1) return "Fit of " + result.spectra.front().name;
    return fmt::format("Fit of {} spectra together", result.spectra.size());
}

}  // namespace

std::string html_report(const FitResult& result, const ReportOrigin& origin) {
    HtmlPage page{.title = title(result),
                  .summary = summary(result),
                  .sections = {spectrum_section(result), parameter_section(result), uncertainty_section(result),
                               colour_section(result), light_section(result), findings_section(result),
                               minima_section(result), provenance_section(result, origin)},
                  .footer = fmt::format("skinfit {}, research software, not a medical device", version)};
    page.sections.push_back(reference_section(page.sections));
    return html_page(page);
}

}  // namespace skinfit
