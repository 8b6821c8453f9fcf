#include "study/assessment_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/html_figure.hpp"
#include "report/html_table.hpp"
#include "study/study_assessment.hpp"
#include "study/study_figures.hpp"
#include "study/study_groups.hpp"

namespace skinfit {
namespace {

Html text(const std::string& words) {
    return escaped(words);
}

std::string interval_text(const Bounds& interval) {
    return fmt::format("{:.3g} to {:.3g}", interval.lower, interval.upper);
}

std::string estimate_text(const std::optional<IntervalEstimate>& estimate) {
    return estimate ? fmt::format("{:.3g} ({})", estimate->value, interval_text(estimate->interval_95)) : "-";
}

std::string share_text(const std::optional<Proportion>& share) {
    if (!share) return "-";
    return fmt::format("{}/{} = {:.3g} ({})", share->count, share->trials, share->share(),
                       interval_text(share->interval_95));
}

std::string optional_text(const std::optional<double>& number) {
    return number ? fmt::format("{:.2g}", *number) : "-";
}

Html picture(const StudyFigure& figure, const std::string& alternative) {
    return html_figure({.picture = svg_of(figure), .alternative = alternative, .caption = ""});
}

/// "above 0.2 g/L", or "above its value at site forearm of the same subject".
std::string question_of(const Indicator& indicator) {
    const std::string side = indicator.above ? "above" : "below";
    const std::string unit = unit_of(indicator.quantity);
    if (indicator.threshold) {
        return fmt::format("{} {} {:g}{}{}{}", indicator.quantity, side, *indicator.threshold, unit.empty() ? "" : " ",
                           unit, indicator.prevalence ? fmt::format(", prevalence {:g}", *indicator.prevalence) : "");
    }
    std::string where;
    for (const auto& [name, word] : indicator.reference->where) {
        where += fmt::format("{}{} {}", where.empty() ? "" : ", ", name, word);
    }
    return fmt::format("{} {} its value at {} of the same {}", indicator.quantity, side, where,
                       indicator.reference->same);
}

/// How many spectra have a probability below, within and above the middle range, and how many have none.
struct ProbabilityCounts {
    std::size_t improbable = 0;  ///< below 0.05
    std::size_t open = 0;
    std::size_t probable = 0;  ///< above 0.95
    std::size_t none = 0;
    std::size_t decided_by_prior = 0;  ///< of those with a probability
};

ProbabilityCounts counts_of(const std::vector<AnsweredRow>& rows, std::size_t indicator) {
    constexpr double small = 0.05;
    ProbabilityCounts counts;
    for (const AnsweredRow& each : rows) {
        const std::optional<double>& probability = each.indicators[indicator].probability;
        if (each.indicators[indicator].decided_by_prior) ++counts.decided_by_prior;
        if (!probability) {
            ++counts.none;
        } else if (*probability < small) {
            ++counts.improbable;
        } else {
            ++(*probability > 1.0 - small ? counts.probable : counts.open);
        }
    }
    return counts;
}

Html points_table(const std::vector<OperatingPoint>& points) {
    HtmlTable table{.caption = "Called positive from these probabilities on; in parentheses 95 % intervals",
                    .columns = {{.name = "probability"},
                                {.name = "true positive"},
                                {.name = "false positive"},
                                {.name = "true negative"},
                                {.name = "false negative"},
                                {.name = "sensitivity", .cells = Cells::text},
                                {.name = "specificity", .cells = Cells::text}},
                    .rows = {}};
    for (const OperatingPoint& point : points) {
        table.rows.push_back({text(fmt::format("{:g}", point.threshold)), text(fmt::format("{}", point.true_positives)),
                              text(fmt::format("{}", point.false_positives)),
                              text(fmt::format("{}", point.true_negatives)),
                              text(fmt::format("{}", point.false_negatives)), text(share_text(point.sensitivity)),
                              text(share_text(point.specificity))});
    }
    return html_table(table);
}

Html calibration_list(const CalibrationAnalysis& calibration) {
    return definition_list(
        {{"positives observed", text(fmt::format("{}", calibration.observed_positives))},
         {"positives expected",
          text(fmt::format("{:.4g} +/- {:.2g} (p = {})", calibration.expected_positives,
                           calibration.expected_positives_sd, optional_text(calibration.positives_p_value)))},
         {"Brier score",
          text(fmt::format("{:.4g}, expected {:.4g}", calibration.brier_score, calibration.expected_brier_score))},
         {"Spiegelhalter's z", text(fmt::format("{} (p = {})", optional_text(calibration.spiegelhalter_z),
                                                optional_text(calibration.spiegelhalter_p_value)))}});
}

Html indicator_part(const Study& study, const Assessment& assessment, const std::vector<AnsweredRow>& rows) {
    const IndicatorAssessment result = assessed(study, assessment, rows);
    const RocAnalysis& roc = result.roc;
    const std::string title = fmt::format("{} against {}", assessment.name, assessment.metadata);
    Html part = subheading(title);
    part += paragraph(fmt::format(
        "{} spectra are positive ({} = {}), {} negative; without a probability are {} positive and {} negative ones.",
        roc.positives, assessment.metadata, assessment.positive, roc.negatives, roc.positives_without_score,
        roc.negatives_without_score));
    if (!roc.area) return part + paragraph(roc.why_no_area);
    part += paragraph(fmt::format("Area under the curve: {:.4g}, 95 % interval {}.", roc.area->value,
                                  interval_text(roc.area->interval_95)));
    if (result.expected_area) {
        part += paragraph(fmt::format("If the probabilities are right, {:.4g} +/- {:.2g} was to be expected.",
                                      result.expected_area->value, result.expected_area->standard_deviation));
    }
    part += picture(roc_figure(roc, result.points, title), "Receiver operating characteristic of " + title);
    part += points_table(result.points);
    if (!result.calibration) return part;
    return part + picture(calibration_figure(*result.calibration, title), "Calibration of " + title) +
           calibration_list(*result.calibration);
}

Html reference_part(const Assessment& assessment, const std::vector<AnsweredRow>& rows) {
    const std::vector<ReferencePair> pairs = pairs_of(assessment, rows);
    const std::optional<MethodAgreement> agreement = method_agreement(pairs);
    Html part = subheading(fmt::format("{} against {}", assessment.name, assessment.metadata));
    if (!agreement) return part + paragraph("Fewer than two spectra have both an estimate and a reference value.");
    const ComparedQuantity quantity{.name = assessment.name, .unit = unit_of(assessment.name)};
    part += picture(bland_altman_figure(pairs, *agreement, quantity), "Differences against means of " + quantity.name);
    part += picture(reference_figure(pairs, *agreement, quantity), "Estimates against references of " + quantity.name);
    std::vector<std::pair<std::string, Html>> items = {
        {"pairs", text(fmt::format("{}, and {} without an estimate", agreement->pairs, agreement->incomplete_pairs))},
        {"bias", text(estimate_text(agreement->bias))},
        {"lower limit of agreement", text(estimate_text(agreement->lower_limit))},
        {"upper limit of agreement", text(estimate_text(agreement->upper_limit))},
        {"Pearson's correlation", text(estimate_text(agreement->pearson))},
        {"Lin's concordance", text(estimate_text(agreement->concordance))}};
    if (agreement->line) items.emplace_back("slope", text(estimate_text(agreement->line->slope)));
    if (agreement->claimed) {
        items.emplace_back("(estimate - reference) / sigma",
                           text(fmt::format("mean {:.3g}, sd {}, p = {:.2g}", agreement->claimed->mean_z,
                                            optional_text(agreement->claimed->sd_z), agreement->claimed->p_value)));
    }
    items.emplace_back("references within 95 % intervals", text(share_text(agreement->coverage)));
    return part + definition_list(items);
}

}  // namespace

HtmlSection repeatability_section(const Study& study, const std::vector<AnsweredRow>& rows) {
    HtmlTable table{.caption = fmt::format("Repeats: spectra of the same {}", study.repeats_of),
                    .columns = {{.name = "quantity", .cells = Cells::text},
                                {.name = "specimens"},
                                {.name = "spectra"},
                                {.name = "sd within specimens", .cells = Cells::text},
                                {.name = "claimed sigma"},
                                {.name = "sd / sigma", .cells = Cells::text},
                                {.name = "p"},
                                {.name = "sd between specimens"},
                                {.name = "intraclass correlation", .cells = Cells::text}},
                    .rows = {}};
    std::vector<NamedScatter> scatters;
    for (const std::string& quantity : quantities_in(rows)) {
        const std::optional<RepeatabilityAnalysis> found = repeatability(repeats_of(study, rows, quantity));
        if (!found) continue;
        const std::optional<ClaimedScatter>& claimed = found->claimed;
        if (claimed) scatters.push_back({.name = quantity, .claimed = *claimed});
        table.rows.push_back({text(quantity), text(fmt::format("{}", found->repeated_specimens)),
                              text(fmt::format("{}", found->repeats)), text(estimate_text(found->within_specimen_sd)),
                              text(claimed ? fmt::format("{:.3g}", claimed->sigma) : "-"),
                              text(claimed ? estimate_text(claimed->ratio) : "-"),
                              text(claimed ? fmt::format("{:.2g}", claimed->p_value) : "-"),
                              text(optional_text(found->between_specimen_sd)),
                              text(estimate_text(found->intraclass_correlation))});
    }
    Html body = table.rows.empty() ? paragraph("No specimen has two spectra with an answer.") : html_table(table);
    if (!scatters.empty()) {
        body += picture(repeatability_figure(scatters, "Scatter of repeats over claimed sigma"),
                        "Scatter of repeats over what is claimed, for each quantity");
    }
    body += paragraph(
        "A ratio of 1 says that the claimed uncertainty is the scatter of repeats. Above 1, repeats differ by more "
        "than "
        "the noise the fits were told of; below 1, by less: a claimed uncertainty may include what repeats share.");
    return {.title = "Repeatability", .body = body, .starts_page = true};
}

HtmlSection indicators_section(const Study& study, const std::vector<AnsweredRow>& rows) {
    HtmlTable table{.caption = "Probabilities by the distribution of the fit, not by the fitted value alone",
                    .columns = {{.name = "indicator", .cells = Cells::text},
                                {.name = "means", .cells = Cells::text},
                                {.name = "source", .cells = Cells::text},
                                {.name = "p < 0.05"},
                                {.name = "0.05 to 0.95"},
                                {.name = "p > 0.95"},
                                {.name = "cannot tell"},
                                {.name = "decided by the prior"}},
                    .rows = {}};
    for (std::size_t i = 0; i < study.indicators.size(); ++i) {
        const Indicator& indicator = study.indicators[i];
        const ProbabilityCounts counts = counts_of(rows, i);
        table.rows.push_back({text(indicator.name), text(question_of(indicator)), text(indicator.source),
                              text(fmt::format("{}", counts.improbable)), text(fmt::format("{}", counts.open)),
                              text(fmt::format("{}", counts.probable)), text(fmt::format("{}", counts.none)),
                              text(fmt::format("{}", counts.decided_by_prior))});
    }
    return {.title = "Indicators",
            .body = html_table(table) +
                    paragraph("Decided by the prior: the spectrum says less about the quantity than its prior does, so "
                              "that the probability is what was assumed, hardly what was measured.")};
}

HtmlSection assessments_section(const Study& study, const std::vector<AnsweredRow>& rows) {
    Html body;
    for (const Assessment& assessment : study.assessments) {
        body += assessment.is_indicator ? indicator_part(study, assessment, rows) : reference_part(assessment, rows);
    }
    return {.title = "Assessment", .body = body, .starts_page = true};
}

}  // namespace skinfit
