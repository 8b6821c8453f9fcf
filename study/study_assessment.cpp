#include "study/study_assessment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"
#include "study/study_groups.hpp"

namespace skinfit {
namespace {

std::vector<ScoredCase> scored(const std::vector<PredictedCase>& cases) {
    std::vector<ScoredCase> scores;
    for (const PredictedCase& each : cases) {
        scores.push_back({.score = each.probability, .is_positive = each.is_positive});
    }
    return scores;
}

Json interval_json(const Bounds& interval) {
    return {interval.lower, interval.upper};
}

Json estimate_json(const IntervalEstimate& estimate) {
    return {{"value", estimate.value}, {"interval_95", interval_json(estimate.interval_95)}};
}

Json estimate_json(const std::optional<IntervalEstimate>& estimate) {
    return estimate ? estimate_json(*estimate) : Json();
}

Json share_json(const std::optional<Proportion>& share) {
    if (!share) return {};
    return {{"count", share->count},
            {"trials", share->trials},
            {"share", share->share()},
            {"interval_95", interval_json(share->interval_95)}};
}

Json number_json(const std::optional<double>& number) {
    return number ? Json(*number) : Json();
}

Json points_json(const std::vector<OperatingPoint>& points) {
    Json json = Json::array();
    for (const OperatingPoint& point : points) {
        json.push_back({{"threshold", point.threshold},
                        {"true_positives", point.true_positives},
                        {"false_positives", point.false_positives},
                        {"true_negatives", point.true_negatives},
                        {"false_negatives", point.false_negatives},
                        {"sensitivity", share_json(point.sensitivity)},
                        {"specificity", share_json(point.specificity)}});
    }
    return json;
}

Json calibration_json(const std::optional<CalibrationAnalysis>& calibration) {
    if (!calibration) return {};
    return {{"cases", calibration->cases},
            {"observed_positives", calibration->observed_positives},
            {"expected_positives", calibration->expected_positives},
            {"positives_p_value", number_json(calibration->positives_p_value)},
            {"brier_score", calibration->brier_score},
            {"expected_brier_score", calibration->expected_brier_score},
            {"spiegelhalter_z", number_json(calibration->spiegelhalter_z)},
            {"spiegelhalter_p_value", number_json(calibration->spiegelhalter_p_value)}};
}

Json indicator_json(const IndicatorAssessment& assessment) {
    const RocAnalysis& roc = assessment.roc;
    Json area;
    if (roc.area) area = {{"value", roc.area->value}, {"interval_95", interval_json(roc.area->interval_95)}};
    Json expected;
    if (assessment.expected_area) {
        expected = {{"value", assessment.expected_area->value},
                    {"standard_deviation", assessment.expected_area->standard_deviation}};
    }
    return {{"positives", roc.positives},
            {"negatives", roc.negatives},
            {"positives_without_score", roc.positives_without_score},
            {"negatives_without_score", roc.negatives_without_score},
            {"area", area},
            {"why_no_area", roc.why_no_area},
            {"expected_area", expected},
            {"points", points_json(assessment.points)},
            {"calibration", calibration_json(assessment.calibration)}};
}

Json agreement_json(const std::optional<MethodAgreement>& agreement) {
    if (!agreement) return {};
    Json json = {{"pairs", agreement->pairs},
                 {"incomplete_pairs", agreement->incomplete_pairs},
                 {"bias", estimate_json(agreement->bias)},
                 {"difference_sd", agreement->difference_sd},
                 {"lower_limit", estimate_json(agreement->lower_limit)},
                 {"upper_limit", estimate_json(agreement->upper_limit)},
                 {"pearson", estimate_json(agreement->pearson)},
                 {"concordance", estimate_json(agreement->concordance)},
                 {"coverage", share_json(agreement->coverage)}};
    if (agreement->line) json["slope"] = estimate_json(agreement->line->slope);
    if (agreement->claimed) {
        json["claimed"] = {{"mean_z", agreement->claimed->mean_z},
                           {"sd_z", number_json(agreement->claimed->sd_z)},
                           {"p_value", agreement->claimed->p_value}};
    }
    return json;
}

/// Words for a case of which nothing is known; `-` and `none` may be labels.
bool is_no_label(const std::string& word) {
    static constexpr std::array<std::string_view, 7> words = {"", "na", "n/a", "nan", "null", "#n/a", "<na>"};
    return std::ranges::find(words, lower_case(word)) != words.end();
}

}  // namespace

std::vector<PredictedCase> cases_of(const Study& study, const Assessment& assessment,
                                    const std::vector<AnsweredRow>& rows) {
    const auto place = static_cast<std::size_t>(std::ranges::find(study.indicators, assessment.name, &Indicator::name) -
                                                study.indicators.begin());
    std::vector<PredictedCase> cases;
    for (const AnsweredRow& each : rows) {
        const std::string label = word_of(each.row.metadata, assessment.metadata);
        if (is_no_label(label)) continue;
        cases.push_back(
            {.probability = each.indicators[place].probability, .is_positive = label == assessment.positive});
    }
    return cases;
}

IndicatorAssessment assessed(const Study& study, const Assessment& assessment, const std::vector<AnsweredRow>& rows) {
    const std::vector<PredictedCase> cases = cases_of(study, assessment, rows);
    std::vector<double> probabilities;
    for (const PredictedCase& each : cases) {
        if (each.probability) probabilities.push_back(*each.probability);
    }
    IndicatorAssessment result{.roc = roc_analysis(scored(cases)),
                               .expected_area = expected_roc_area(probabilities),
                               .points = {},
                               .calibration = calibration_analysis(cases)};
    for (const double threshold : assessment.thresholds) {
        result.points.push_back(operating_point(scored(cases), threshold));
    }
    return result;
}

std::vector<ReferencePair> pairs_of(const Assessment& assessment, const std::vector<AnsweredRow>& rows) {
    std::vector<ReferencePair> pairs;
    for (const AnsweredRow& each : rows) {
        const std::string word = word_of(each.row.metadata, assessment.metadata);
        const std::optional<double> reference = parse_number(word);
        if (is_missing(word) || (reference && is_fill_number(*reference))) continue;
        if (!reference || !std::isfinite(*reference)) {
            throw InputError({.where = fmt::format("{} {}", each.row.key.source, each.row.key.name),
                              .problem = fmt::format(R"("{}" is "{}")", assessment.metadata, word),
                              .why = fmt::format("it is the reference value of {}, a number", assessment.name),
                              .remedy = "correct it in the manifest, or leave the cell empty"});
        }
        const std::optional<QuantityEstimate> estimate = estimate_of(each.row, assessment.name);
        pairs.push_back({.estimate = estimate ? estimate->value : std::numeric_limits<double>::quiet_NaN(),
                         .reference = *reference,
                         .sigma = estimate ? estimate->sigma : std::nullopt,
                         .interval_95 = estimate ? estimate->interval_95 : std::nullopt});
    }
    return pairs;
}

Json assessments_json(const Study& study, const std::vector<AnsweredRow>& rows) {
    Json json = Json::array();
    for (const Assessment& assessment : study.assessments) {
        Json one = {{assessment.is_indicator ? "indicator" : "quantity", assessment.name},
                    {assessment.is_indicator ? "label" : "reference", assessment.metadata}};
        one.update(assessment.is_indicator
                       ? indicator_json(assessed(study, assessment, rows))
                       : Json{{"agreement", agreement_json(method_agreement(pairs_of(assessment, rows)))}});
        json.push_back(one);
    }
    return json;
}

Json repeatability_json(const Study& study, const std::vector<AnsweredRow>& rows) {
    if (study.repeats_of.empty()) return {};
    Json json = Json::object();
    for (const std::string& quantity : quantities_in(rows)) {
        const std::optional<RepeatabilityAnalysis> found = repeatability(repeats_of(study, rows, quantity));
        if (!found) continue;
        Json one = {{"specimens", found->repeated_specimens},
                    {"spectra", found->repeats},
                    {"within_specimen_sd", estimate_json(found->within_specimen_sd)},
                    {"between_specimen_sd", number_json(found->between_specimen_sd)},
                    {"intraclass_correlation", estimate_json(found->intraclass_correlation)}};
        if (found->claimed) {
            one["claimed_sigma"] = found->claimed->sigma;
            one["ratio"] = estimate_json(found->claimed->ratio);
            one["p_value"] = found->claimed->p_value;
        }
        json[quantity] = one;
    }
    return json;
}

}  // namespace skinfit
