#pragma once

#include <string>
#include <vector>

#include "fit/plot_sheet.hpp"
#include "fit/settings.hpp"
#include "validation/figure_run.hpp"

/// Computed figures as tables and pictures: pure functions of their results.
namespace skinfit {

/// Every point of every curve. Columns panel, edition, fibril_radius_nm, series, then of spectra wavelength_nm and
/// reflectance or transmittance; of goniophotometers kind (`inplane_forward`, `inplane_back`, `ring`), polar_lo_deg,
/// polar_hi_deg, bsdf_per_sr (the BRDF, or the BTDF of a panel of transmitted light) and bsdf_se. Comments on top hold
/// the title, the sources of all values, and the rendered colours.
[[nodiscard]] std::string figure_csv(const FigureResult& result);

/// A row per panel, a column per variant. Spectra over wavelength; what a goniophotometer sees above in the plane of
/// incidence, and what it sees below as means over azimuth.
[[nodiscard]] PlotSheet figure_sheet(const FigureResult& result);

/// The verdicts on all claims, one below the other, each with the number that decided and the reason.
[[nodiscard]] std::string summary_text(const std::vector<FigureResult>& results);

/// The same, with the figures' titles and what the paper shows in them.
[[nodiscard]] Json summary_json(const std::vector<FigureResult>& results);

}  // namespace skinfit
