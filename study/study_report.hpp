#pragma once

#include <string>

#include "study/study_output.hpp"

namespace skinfit {

/// Everything that a report of a study needs.
struct StudyResults {
    std::vector<AnsweredRow> rows;  ///< of all spectra
    std::vector<CubeRow> cubes;
    StudyCounts counts;
    Json configuration;   ///< of the fits
    std::string version;  ///< of the program that fitted
};

/// What the rows of `ledger` say to the questions of `study`.
[[nodiscard]] StudyResults results_of(const Study& study, const Ledger& ledger);

/// The report as a page that needs nothing but itself: counts; what was rejected and failed, and why; parameters by
/// groups; repeats against claimed uncertainties; indicators with their definitions; assessments against labels and
/// reference values; maps; provenance. Throws InputError when gnuplot is missing or fails.
[[nodiscard]] std::string study_page(const Study& study, const StudyResults& results);

}  // namespace skinfit
