#pragma once

#include <string>

#include "fit/result.hpp"

namespace skinfit {

/// What a report states beside the result.
struct ReportOrigin {
    std::string command_line;  ///< that led to the result; none where it is empty
    std::string other{};       ///< what else did, and how to have the result again, in words; none where it is empty
};

/// The report of a fit as one self-contained HTML page: verdict, spectrum and residuals, parameters, what the spectrum
/// can tell, colour, where the light goes, findings, minima, provenance, references. Where the light goes is computed
/// by the angular solver at the fitted values, some milliseconds a wavelength. Throws InputError when gnuplot, which
/// draws the pictures, is missing or fails.
[[nodiscard]] std::string html_report(const FitResult& result, const ReportOrigin& origin);

}  // namespace skinfit
