#include "study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/file.hpp"
#include "fit/report.hpp"
#include "report/html_figure.hpp"
#include "report/html_page.hpp"
#include "report/html_table.hpp"
#include "study/assessment_sections.hpp"
#include "study/colour_classes.hpp"
#include "study/study_groups.hpp"

namespace skinfit {
namespace {

Html number_cell(double value, int digits) {
    return escaped(std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-");
}

Html count_cell(std::uint64_t count) {
    return escaped(fmt::format("{}", count));
}

/// Statuses that a table of counts shows.
constexpr std::array shown_statuses = {FitStatus::fitted, FitStatus::suspect, FitStatus::rejected, FitStatus::failed,
                                       FitStatus::pending};

std::vector<HtmlColumn> count_columns(const std::string& first) {
    std::vector<HtmlColumn> columns = {{.name = first, .cells = Cells::text}};
    for (const FitStatus status : shown_statuses) columns.push_back({.name = std::string(name_of(status))});
    return columns;
}

std::vector<Html> count_row(const Html& name, const StatusCounts& counts) {
    std::vector<Html> row = {name};
    for (const FitStatus status : shown_statuses) row.push_back(count_cell(counts[static_cast<std::size_t>(status)]));
    return row;
}

Html summary(const StudyResults& results) {
    HtmlTable table{.caption = "", .columns = count_columns("what"), .rows = {}};
    table.rows.push_back(count_row(escaped("spectra"), results.counts.spectra));
    if (!results.cubes.empty()) table.rows.push_back(count_row(escaped("pixels"), results.counts.pixels));
    return html_table(table) +
           paragraph(
               "Fitted: with a consistent answer. Suspect: with an answer and reasons to doubt it. Rejected: not "
               "fitted, since a check of the spectrum says that no fit could be trusted. Failed: without an answer.");
}

HtmlSection reasons_section(const StudyResults& results) {
    HtmlTable table{.caption = "Spectra that are not simply fitted, by reason; one may have several",
                    .columns = {{.name = "reason", .cells = Cells::text},
                                {.name = "status", .cells = Cells::text},
                                {.name = "spectra"},
                                {.name = "for example", .cells = Cells::text}},
                    .rows = {}};
    for (const ReasonCount& count : reasons_in(results.rows)) {
        table.rows.push_back(
            {escaped(count.reason), badge(name_of(count.status)), count_cell(count.spectra), escaped(count.example)});
    }
    Html body = table.rows.empty() ? paragraph("Every spectrum is fitted.") : html_table(table);
    for (const auto& [source, reason] : results.counts.unread_cubes) {
        body += paragraph(badge("failed") + escaped(fmt::format(" {}: {}", source, reason)));
    }
    return {.title = "What was rejected, failed or is suspect", .body = body};
}

Html group_table(const std::vector<StudyGroup>& groups, const std::string& quantity) {
    HtmlTable table{.caption = "",
                    .columns = {{.name = "group", .cells = Cells::text},
                                {.name = "spectra"},
                                {.name = "mean", .unit = unit_of(quantity)},
                                {.name = "sd between spectra", .unit = unit_of(quantity)},
                                {.name = "median", .unit = unit_of(quantity)},
                                {.name = "median claimed sigma", .unit = unit_of(quantity)},
                                {.name = "decided by its prior"},
                                {.name = "split by the model"}},
                    .rows = {}};
    for (const StudyGroup& group : groups) {
        const std::optional<GroupSummary> found = summary_of(group, quantity);
        if (!found) continue;
        table.rows.push_back({escaped(group.name), count_cell(found->spectra), number_cell(found->mean, 4),
                              number_cell(found->sd, 2), number_cell(found->median, 4),
                              number_cell(found->median_sigma, 2), count_cell(found->decided_by_prior),
                              count_cell(found->split_by_model)});
    }
    return html_table(table);
}

Html group_picture(const std::vector<StudyGroup>& groups, const std::string& quantity) {
    constexpr std::size_t most = 20;  // boxes that can be told apart
    std::vector<ValueGroup> values;
    for (const StudyGroup& group : groups) {
        ValueGroup one{.name = group.name, .values = {}};
        for (const AnsweredRow* const each : group.rows) {
            if (const auto estimate = estimate_of(each->row, quantity)) one.values.push_back(estimate->value);
        }
        if (!one.values.empty() && values.size() < most) values.push_back(std::move(one));
    }
    return html_figure(
        {.picture = svg_of(group_figure(values, {.name = quantity, .unit = unit_of(quantity)})),
         .alternative = fmt::format("Values of {} in each group, with boxes of their quartiles", quantity),
         .caption = groups.size() > most ? fmt::format("the first {} of {} groups", most, groups.size()) : ""});
}

/// How many spectra of each group have which colour, to be expected by the probabilities of each.
Html colour_table(const std::vector<StudyGroup>& groups) {
    HtmlTable table{.caption =
                        "Classes of skin colour by the individual typology angle [CHARDON91] [DELBINO06]: expected "
                        "numbers of spectra, each counted by the probabilities of its classes",
                    .columns = {{.name = "group", .cells = Cells::text}},
                    .rows = {}};
    for (std::size_t i = 0; i < skin_colour_count; ++i) {
        table.columns.push_back({.name = std::string(name_of(static_cast<SkinColour>(i)))});
    }
    for (const StudyGroup& group : groups) {
        ColourClassProbabilities expected{};
        for (const AnsweredRow* const each : group.rows) {
            const std::optional<ColourClassProbabilities> classes = colour_classes_of(each->row.studied);
            for (std::size_t i = 0; classes && i < expected.size(); ++i) expected[i] += (*classes)[i];
        }
        std::vector<Html> row = {escaped(group.name)};
        for (const double number : expected) row.push_back(escaped(fmt::format("{:.1f}", number)));
        table.rows.push_back(std::move(row));
    }
    return html_table(table);
}

HtmlSection groups_section(const Study& study, const StudyResults& results) {
    const std::vector<StudyGroup> groups = groups_of(study, results.rows);
    Html body;
    if (!study.group_by.empty()) {
        HtmlTable table{.caption = "Spectra by group", .columns = count_columns("group"), .rows = {}};
        for (const StudyGroup& group : groups) table.rows.push_back(count_row(escaped(group.name), group.counts));
        body += html_table(table);
    }
    for (const std::string& quantity : quantities_in(results.rows)) {
        body += subheading(quantity) + group_table(groups, quantity) + group_picture(groups, quantity);
    }
    if (body.markup.empty()) body = paragraph("No spectrum has an answer.");
    const bool has_colours = std::ranges::any_of(
        results.rows, [](const AnsweredRow& each) { return colour_classes_of(each.row.studied).has_value(); });
    if (has_colours) body += subheading("skin colour") + colour_table(groups);
    return {.title = "Parameters and indices", .body = body, .starts_page = true};
}

/// The pictures of a map that are there, by name.
std::vector<std::filesystem::path> pictures_of(const std::filesystem::path& map) {
    std::vector<std::filesystem::path> pictures;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(map.parent_path(), ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(map.stem().string() + "_") && name.ends_with(".png")) pictures.push_back(entry.path());
    }
    std::ranges::sort(pictures);
    return pictures;
}

HtmlSection maps_section(const StudyResults& results) {
    Html body;
    for (const CubeRow& cube : results.cubes) {
        HtmlTable table{.caption = cube.source, .columns = count_columns("what"), .rows = {}};
        table.rows.push_back(count_row(escaped("pixels"), cube.pixels));
        body += subheading(cube.source) + html_table(table);
        if (cube.map.empty()) {
            body += paragraph(cube.reason.empty() ? fmt::format("{} of {} tiles are done.", cube.tiles_done, cube.tiles)
                                                  : cube.reason);
            continue;
        }
        body += paragraph(fmt::format("Map: {}", cube.map));
        for (const std::filesystem::path& picture : pictures_of(cube.map)) {
            body += html_figure({.picture = read_file(picture),
                                 .alternative = fmt::format("Map {}", picture.stem().string()),
                                 .caption = picture.filename().string()});
        }
    }
    return {.title = "Images", .body = body, .starts_page = true};
}

HtmlSection provenance_section(const Study& study, const StudyResults& results) {
    std::vector<std::pair<std::string, Html>> items = {
        {"study", escaped(study.file.string())},
        {"program", escaped("skinfit " + results.version)},
        {"inputs", escaped(fmt::format("{} files, {} cubes", study.files.size(), study.cubes.size()))}};
    for (const char* key : {"preset", "edition", "engine", "uncertainty", "seed"}) {
        items.emplace_back(key, escaped(results.configuration.at(key).dump()));
    }
    const Json& noise = results.configuration.at("noise");
    items.emplace_back("noise",
                       escaped(fmt::format("as the files state it, else {}",
                                           noise.is_null() ? fmt::format("{}", default_noise) : noise.dump())));
    items.emplace_back("discrepancy", escaped(results.configuration.at("discrepancy").dump()));
    for (const IndexInfo& info : index_table()) {
        items.emplace_back(std::string(info.name), escaped(fmt::format("{} {}", info.meaning, info.source)));
    }
    return {.title = "Provenance",
            .body = definition_list(items) + folded_text("configuration of the fits", results.configuration.dump(2))};
}

}  // namespace

StudyResults results_of(const Study& study, const Ledger& ledger) {
    return {.rows = answered(study, ledger.rows()),
            .cubes = cube_rows(ledger),
            .counts = counts_of(ledger),
            .configuration = configuration_in(ledger),
            .version = ledger.note("version")};
}

std::string study_page(const Study& study, const StudyResults& results) {
    HtmlPage page{.title = study.name,
                  .summary = summary(results),
                  .sections = {},
                  .footer = fmt::format("skinfit {}. Research software, not a medical device.", results.version)};
    page.sections.push_back(reasons_section(results));
    page.sections.push_back(groups_section(study, results));
    if (!study.repeats_of.empty()) page.sections.push_back(repeatability_section(study, results.rows));
    if (!study.indicators.empty()) page.sections.push_back(indicators_section(study, results.rows));
    if (!study.assessments.empty()) page.sections.push_back(assessments_section(study, results.rows));
    if (!results.cubes.empty()) page.sections.push_back(maps_section(results));
    page.sections.push_back(provenance_section(study, results));
    return html_page(page);
}

}  // namespace skinfit
