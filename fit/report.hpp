#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/result.hpp"
#include "fit/settings.hpp"
#include "model/spectrophotometer.hpp"

/// Reports: pure functions of results.
namespace skinfit {

/// The words of JSON and tables.
[[nodiscard]] std::string_view name_of(Verdict verdict);
[[nodiscard]] std::string_view name_of(Status status);

/// The value of a setting of `to_json(Configuration)`, as reports for people print it.
[[nodiscard]] std::string setting_word(const Json& configuration, const char* key);

/// Quantity, geometry and bandpass of a fit, in words.
[[nodiscard]] std::string instrument_words(const ResolvedConfiguration& configuration);

/// The error of the computed readings, in words.
[[nodiscard]] std::string model_error_words(const FitResult& result);

/// rmse, with and without what the discrepancy takes, and chi2, in words.
[[nodiscard]] std::string misfit_words(const FitResult& result);

/// The noise and the discrepancy against which a fit was judged, in words.
[[nodiscard]] std::string assumed_words(const FitResult& result);

/// How many starts, at how many minima their searches ended, and which of these were left out.
[[nodiscard]] std::string search_words(const FitResult& result);

/// The report for people: verdict first, values rounded to two digits of their standard deviation.
[[nodiscard]] std::string text_report(const FitResult& result);

/// The report for programs, complete enough to run the fit again.
[[nodiscard]] Json json_report(const FitResult& result);

/// Where the intervals come from, what the spectrum can tell and how well the posterior was sampled: a section of the
/// report for people, and keys of the report for programs.
[[nodiscard]] std::string uncertainty_text(const FitResult& result);
[[nodiscard]] Json uncertainty_json(const FitResult& result);

/// A simulation as CSV, with its settings as comments on top, readable by `read_spectrum`.
[[nodiscard]] std::string simulation_csv(const std::vector<Reading>& readings, const Configuration& configuration);

/// A simulation as JSON.
[[nodiscard]] Json simulation_json(const std::vector<Reading>& readings, const Configuration& configuration);

}  // namespace skinfit
