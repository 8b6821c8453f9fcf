#pragma once

#include <string>
#include <vector>

#include "study/answers.hpp"
#include "study/repeatability.hpp"
#include "study/study_figures.hpp"

/// What a report says of the answers of a study as a whole.
namespace skinfit {

/// Spectra with an answer (fitted or suspect) that share their words under `Study::group_by`; one group of all where
/// the study has none.
struct StudyGroup {
    std::string name;  ///< the words, joined by commas
    StatusCounts counts{};
    std::vector<const AnsweredRow*> rows;  ///< with an answer
};

/// In the order in which they are met.
[[nodiscard]] std::vector<StudyGroup> groups_of(const Study& study, const std::vector<AnsweredRow>& rows);

/// The names of all parameters, quantities of the tissue and indices that some spectrum has, in the order of their
/// tables.
[[nodiscard]] std::vector<std::string> quantities_in(const std::vector<AnsweredRow>& rows);

/// Its unit; empty for a pure number.
[[nodiscard]] std::string unit_of(const std::string& quantity);

/// A quantity over the spectra of a group that have it.
struct GroupSummary {
    std::size_t spectra = 0;
    double mean = 0.0;
    double sd = 0.0;  ///< between spectra; NaN for one
    double median = 0.0;
    double median_sigma = 0.0;         ///< claimed; NaN where none has one
    std::size_t decided_by_prior = 0;  ///< spectra of which the prior of the quantity says more than they do
    std::size_t split_by_model = 0;    ///< spectra that do not say how it shares an amount with another (`ModelSplit`)
};

/// None where no spectrum has the quantity.
[[nodiscard]] std::optional<GroupSummary> summary_of(const StudyGroup& group, const std::string& quantity);

/// The repeats of a quantity: spectra with an answer that share the word under `Study::repeats_of`.
[[nodiscard]] std::vector<RepeatedEstimate> repeats_of(const Study& study, const std::vector<AnsweredRow>& rows,
                                                       const std::string& quantity);

/// Spectra of one status with the same reason, as far as its first words tell.
struct ReasonCount {
    FitStatus status;
    std::string reason;  ///< the words before the first colon
    std::size_t spectra;
    std::string example;  ///< the first of them, and what was said of it
};

/// Of all but fitted spectra, the most frequent first. A suspect spectrum counts under each of its reasons.
[[nodiscard]] std::vector<ReasonCount> reasons_in(const std::vector<AnsweredRow>& rows);

}  // namespace skinfit
