#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/agreement.hpp"
#include "study/answers.hpp"
#include "study/calibration.hpp"
#include "study/roc.hpp"

namespace skinfit {

/// The cases of an indicator: spectra whose metadata have a word for the label, other than NA and its kin.
[[nodiscard]] std::vector<PredictedCase> cases_of(const Study& study, const Assessment& assessment,
                                                  const std::vector<AnsweredRow>& rows);

/// An indicator against its label.
struct IndicatorAssessment {
    RocAnalysis roc;
    std::optional<ExpectedRocArea> expected_area;  ///< by the probabilities themselves
    std::vector<OperatingPoint> points;            ///< at the thresholds of the assessment
    std::optional<CalibrationAnalysis> calibration;
};

/// One assessment of an indicator by the rows of a ledger.
[[nodiscard]] IndicatorAssessment assessed(const Study& study, const Assessment& assessment,
                                           const std::vector<AnsweredRow>& rows);

/// The pairs of an estimate and its reference value: spectra whose metadata hold a number, other than those that stand
/// for none (`is_missing`, `is_fill_number`). Throws InputError for other words.
[[nodiscard]] std::vector<ReferencePair> pairs_of(const Assessment& assessment, const std::vector<AnsweredRow>& rows);

/// All assessments of a study as JSON.
[[nodiscard]] Json assessments_json(const Study& study, const std::vector<AnsweredRow>& rows);

/// The scatter of repeats of every parameter and index as JSON; null where the study has no repeats.
[[nodiscard]] Json repeatability_json(const Study& study, const std::vector<AnsweredRow>& rows);

}  // namespace skinfit
