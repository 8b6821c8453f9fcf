#include "study/study_power.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/input_error.hpp"
#include "study/question_reading.hpp"
#include "study/study_assessment.hpp"

namespace skinfit {
namespace {

/// Estimates less the mean of their group, by specimen.
struct Scatter {
    std::vector<RepeatedEstimate> estimates;
    double squares = 0.0;
    std::size_t degrees_of_freedom = 0;
};

Scatter scatter_of(const Study& study, const std::vector<StudyGroup>& groups, const std::string& quantity) {
    Scatter scatter;
    for (const StudyGroup& group : groups) {
        const std::optional<GroupSummary> summary = summary_of(group, quantity);
        if (!summary) continue;
        scatter.degrees_of_freedom += summary->spectra - 1;
        for (const AnsweredRow* const each : group.rows) {
            const std::optional<QuantityEstimate> estimate = estimate_of(each->row, quantity);
            if (!estimate) continue;
            const double departure = estimate->value - summary->mean;
            scatter.squares += departure * departure;
            scatter.estimates.push_back({.specimen = word_of(each->row.metadata, study.repeats_of),
                                         .estimate = departure,
                                         .sigma = std::nullopt});
        }
    }
    return scatter;
}

std::optional<RepeatabilityAnalysis> repeats_in(const Study& study, const Scatter& scatter) {
    return study.repeats_of.empty() ? std::nullopt : repeatability(scatter.estimates);
}

TwoGroupDesign design_of(const Study& study, const Scatter& scatter, const PowerQuestion& question) {
    TwoGroupDesign design{
        .between_subject_sd = std::sqrt(scatter.squares / static_cast<double>(scatter.degrees_of_freedom)),
        .measurement_sd = 0.0,
        .repeats = question.repeats};
    const std::optional<RepeatabilityAnalysis> repeats = repeats_in(study, scatter);
    if (repeats) {
        design.measurement_sd = repeats->within_specimen_sd.value;
        design.between_subject_sd = repeats->between_specimen_sd.value_or(0.0);
    }
    return design;
}

std::optional<double> slope_of(const std::vector<AnsweredRow>& rows, const std::string& quantity) {
    const Assessment truth{.name = quantity, .is_indicator = false, .metadata = "true_" + quantity, .positive = {}};
    const std::optional<MethodAgreement> agreement = method_agreement(pairs_of(truth, rows));
    if (!agreement || !agreement->line) return std::nullopt;
    return agreement->line->slope.value;
}

void add_contrasts(PowerAnswer& answer) {
    for (std::size_t i = 1; i < answer.groups.size(); ++i) {
        const double difference = answer.groups[i].mean - answer.groups.front().mean;
        // The design's slope belongs to true differences; this one is of estimates.
        TwoGroupDesign of_estimates = answer.design;
        of_estimates.slope = 1.0;
        answer.contrasts.push_back({.first = answer.groups.front().name,
                                    .second = answer.groups[i].name,
                                    .difference = difference,
                                    .subjects = subjects_needed(of_estimates, difference, answer.question.power)});
    }
}

}  // namespace

PowerAnswer power_answer(const Study& study, const std::vector<AnsweredRow>& rows, const PowerQuestion& question) {
    check_quantity(question.quantity, study.configuration, "--quantity");
    const std::vector<StudyGroup> groups = groups_of(study, rows);
    const Scatter scatter = scatter_of(study, groups, question.quantity);
    if (scatter.degrees_of_freedom == 0 || !(scatter.squares > 0.0)) {
        throw InputError({.where = question.quantity,
                          .problem = "has no scatter in the study",
                          .why = "no group has two different estimates of it",
                          .remedy = "run the study first, with more spectra in a group"});
    }
    const bool knows_repeats = repeats_in(study, scatter).has_value();
    if (question.repeats > 1 && !knows_repeats) {
        throw InputError({.where = "--repeats",
                          .problem = fmt::format("{} cannot be reckoned with", question.repeats),
                          .why = "the study does not tell how far repeats scatter: no specimen is measured twice, or "
                                 "\"repeats_of\" does not say which spectra are of one",
                          .remedy = "leave it out, or state \"repeats_of\""});
    }
    PowerAnswer answer{.question = question,
                       .knows_repeats = knows_repeats,
                       .design = design_of(study, scatter, question),
                       .slope_source = "taken as 1: the study knows no true values",
                       .groups = {},
                       .detectable = {},
                       .contrasts = {}};
    if (const std::optional<double> slope = slope_of(rows, question.quantity)) {
        answer.design.slope = *slope;
        answer.slope_source = "the slope of estimates against true values";
    }
    for (const StudyGroup& group : groups) {
        const std::optional<GroupSummary> summary = summary_of(group, question.quantity);
        if (summary) answer.groups.push_back({.name = group.name, .spectra = summary->spectra, .mean = summary->mean});
    }
    for (const std::size_t subjects : question.subjects) {
        answer.detectable.push_back(detectable_difference(answer.design, subjects, question.power));
    }
    add_contrasts(answer);
    return answer;
}

std::string power_text(const PowerAnswer& answer) {
    const std::string unit = unit_of(answer.question.quantity);
    const std::string of_unit = unit.empty() ? "" : " " + unit;
    std::string text = fmt::format("{}: two groups, two-sided t test at level {:g}, power {:g}\n",
                                   answer.question.quantity, answer.design.significance_level, answer.question.power);
    text += answer.knows_repeats
                ? fmt::format(
                      "standard deviation of estimates between subjects {:.3g}{}, of repeats {:.3g}{}; "
                      "measurements per subject {}\n",
                      answer.design.between_subject_sd, of_unit, answer.design.measurement_sd, of_unit,
                      answer.design.repeats)
                : fmt::format(
                      "standard deviation of estimates {:.3g}{}; that of repeats is unknown, so that one "
                      "measurement per subject is reckoned with\n",
                      answer.design.between_subject_sd, of_unit);
    text += fmt::format("a true difference shows in the estimates at {:.3g} of its size ({})\n\n", answer.design.slope,
                        answer.slope_source);
    text += "  subjects per group   detectable true difference\n";
    for (std::size_t i = 0; i < answer.detectable.size(); ++i) {
        const std::optional<double>& difference = answer.detectable[i];
        text += fmt::format(
            "  {:>18}   {}\n", answer.question.subjects[i],
            difference ? fmt::format("{:.3g}{}", *difference, of_unit) : "none: estimates do not follow true values");
    }
    if (!answer.contrasts.empty()) text += "\ngroups of the study, by their mean estimates\n";
    for (const GroupContrast& contrast : answer.contrasts) {
        text += fmt::format("  {} against {}: difference {:.3g}{}, {}\n", contrast.second, contrast.first,
                            contrast.difference, of_unit,
                            contrast.subjects ? fmt::format("{} subjects per group", *contrast.subjects)
                                              : "more than a million subjects per group");
    }
    return text;
}

Json power_json(const PowerAnswer& answer) {
    Json detectable = Json::array();
    for (std::size_t i = 0; i < answer.detectable.size(); ++i) {
        const std::optional<double>& difference = answer.detectable[i];
        detectable.push_back({{"subjects_per_group", answer.question.subjects[i]},
                              {"difference", difference ? Json(*difference) : Json()}});
    }
    Json groups = Json::array();
    for (const GroupMean& group : answer.groups) {
        groups.push_back({{"name", group.name}, {"spectra", group.spectra}, {"mean", group.mean}});
    }
    Json contrasts = Json::array();
    for (const GroupContrast& contrast : answer.contrasts) {
        contrasts.push_back({{"first", contrast.first},
                             {"second", contrast.second},
                             {"difference", contrast.difference},
                             {"subjects_per_group", contrast.subjects ? Json(*contrast.subjects) : Json()}});
    }
    return {{"quantity", answer.question.quantity},
            {"unit", unit_of(answer.question.quantity)},
            {"power", answer.question.power},
            {"significance_level", answer.design.significance_level},
            {"between_subject_sd", answer.design.between_subject_sd},
            {"measurement_sd", answer.knows_repeats ? Json(answer.design.measurement_sd) : Json()},
            {"repeats", answer.design.repeats},
            {"slope", answer.design.slope},
            {"slope_source", answer.slope_source},
            {"detectable", detectable},
            {"groups", groups},
            {"contrasts", contrasts}};
}

}  // namespace skinfit
