#pragma once

#include "fit/result.hpp"
#include "report/html_page.hpp"

/// The sections of the report of a fit.
namespace skinfit {

/// Measured and modelled spectra, residuals, misfit.
[[nodiscard]] HtmlSection spectrum_section(const FitResult& result);

/// The free parameters as a table and over the ranges of healthy skin, and the fixed ones.
[[nodiscard]] HtmlSection parameter_section(const FitResult& result);

/// Where the intervals come from, correlations, what the spectrum can tell, the posterior.
[[nodiscard]] HtmlSection uncertainty_section(const FitResult& result);

/// Swatches of each spectrum, measured and modelled, with their coordinates.
[[nodiscard]] HtmlSection colour_section(const FitResult& result);

/// What reflects and absorbs the light.
[[nodiscard]] HtmlSection light_section(const FitResult& result);

/// What was found wrong with the spectra before the fit.
[[nodiscard]] HtmlSection findings_section(const FitResult& result);

/// Where the searches ended, and other solvers.
[[nodiscard]] HtmlSection minima_section(const FitResult& result);

}  // namespace skinfit
