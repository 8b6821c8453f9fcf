#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/settings.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// The settings that a measured file decides where nothing else states them.
inline constexpr std::array<std::string_view, 10> measurement_settings = {
    "quantity",       "incidence_deg",     "specular", "viewing_cone_deg", "instrument",
    "bandpass_shape", "bandpass_width_nm", "edition",  "layers",           "base"};

/// What a page says of a model: {"configuration": {...}, "source": name, "measured": [spectra of `spectra_json`]}.
struct MeasuredRequest {
    Json stated;                    ///< the configuration, as far as it is stated
    std::string source;             ///< the files of the spectra, as the page names them
    std::vector<Spectrum> spectra;  ///< that the model is to explain
};

/// The parts of `request`, of which each may be missing. Throws InputError for spectra that cannot be read.
[[nodiscard]] MeasuredRequest measured_request(const Json& request);

/// What the page states, whatever its spectra state.
[[nodiscard]] Configuration stated_configuration(const MeasuredRequest& request);

/// The configuration by which the spectra are fitted together: what is stated, else what they state of edition, layers
/// and base, else `explore_configuration`. Throws InputError.
[[nodiscard]] Configuration fit_configuration(const MeasuredRequest& request);

/// A model as a fit of some of the spectra takes it.
struct MeasuredModel {
    Configuration configuration;       ///< states all that is decided for the fit
    std::vector<std::size_t> spectra;  ///< which of the request's it explains; none where there are none
    /// Of each of `measurement_settings`, who decides it: "stated", "instrument" (the stated one), "file" or "default".
    Json decided_by;
};

/// The models of the spectra, each fitted by itself: one for all that the same configuration explains, in the order of
/// the spectra; of no spectra, that of what is stated and the defaults. Throws InputError as a fit, and for more than
/// four.
[[nodiscard]] std::vector<MeasuredModel> measured_models(const MeasuredRequest& request);

}  // namespace skinfit
