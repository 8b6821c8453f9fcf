#pragma once

#include <vector>

#include "report/html_page.hpp"
#include "study/answers.hpp"

/// Sections of the report of a study that hold its answers against something.
namespace skinfit {

/// The scatter of repeats against the claimed uncertainties.
[[nodiscard]] HtmlSection repeatability_section(const Study& study, const std::vector<AnsweredRow>& rows);

/// What the indicators mean and how many spectra have which probability.
[[nodiscard]] HtmlSection indicators_section(const Study& study, const std::vector<AnsweredRow>& rows);

/// Indicators against labels, and estimates against reference values.
[[nodiscard]] HtmlSection assessments_section(const Study& study, const std::vector<AnsweredRow>& rows);

}  // namespace skinfit
