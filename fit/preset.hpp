#pragma once

#include "fit/configuration.hpp"
#include "fit/settings.hpp"

namespace skinfit {

/// `configuration` with what the preset says of it; what the preset is silent about stays. From another preset than
/// `Preset::paper` it goes by `default_configuration`.
[[nodiscard]] Configuration with_preset(const Configuration& configuration, Preset preset);

/// What fits of measured spectra begin with unless something else is stated: `Preset::skin`.
[[nodiscard]] Configuration measured_configuration();

/// The setting `preset`.
[[nodiscard]] Setting preset_setting();

}  // namespace skinfit
