#pragma once

#include <vector>

#include "fit/settings.hpp"

namespace skinfit {

/// The settings of the instrument beside its geometry: its name and its bandpass.
[[nodiscard]] std::vector<Setting> instrument_settings();

}  // namespace skinfit
