#pragma once

#include <string>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/settings.hpp"
#include "model/band.hpp"
#include "model/goniophotometer.hpp"
#include "model/reciprocity.hpp"

/// Goniophotometer measurements as CSV and JSON: pure functions of a run.
namespace skinfit {

/// What was measured, and how.
struct GoniophotometerRun {
    Configuration configuration;
    std::vector<double> wavelengths_nm;
    BandIlluminant illuminant = BandIlluminant::equal_energy;
    std::string response;  ///< the file's name; empty without one
    Light light = Light::reflected;
    AngularSpectrum spectrum;  ///< without counts where only both ways were compared
};

/// The words of options and output: equal_energy, d65, d65_v; total, surface, subsurface.
[[nodiscard]] std::string_view name_of(BandIlluminant illuminant);
[[nodiscard]] std::string_view name_of(Light light);

/// Columns kind, polar_lo_deg, polar_hi_deg, azimuth_deg, brdf_per_sr, brdf_se, with the settings as comments on top.
/// Kinds: `polar`, means over azimuth (azimuth_deg -1); `inplane_back` (180) and `inplane_forward` (0), the bins
/// centred on the plane of incidence, from horizon over normal to horizon; `transmitted_polar`, as `polar` but below,
/// only where something is transmitted.
[[nodiscard]] std::string goniophotometer_csv(const GoniophotometerRun& run);

/// The same with every bin, and the counts of all rays of each wavelength.
[[nodiscard]] Json goniophotometer_json(const GoniophotometerRun& run);

/// Both ways between pairs of polar bins: columns polar_a_lo_deg to polar_b_hi_deg, azimuth_deg (-1, 0 or 180),
/// brdf_a_to_b_per_sr, brdf_a_to_b_se, the same for b_to_a, and z.
[[nodiscard]] std::string reciprocity_csv(const std::vector<ReciprocityPair>& pairs, const GoniophotometerRun& run);

/// The same as JSON.
[[nodiscard]] Json reciprocity_json(const std::vector<ReciprocityPair>& pairs, const GoniophotometerRun& run);

}  // namespace skinfit
