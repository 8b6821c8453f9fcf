#pragma once

#include <string>

#include "fit/configuration.hpp"
#include "fit/settings.hpp"

namespace skinfit {

/// From where the page starts: `default_configuration`, fitted by the emulator, which answers while one looks, and
/// drawn in steps that show the bands of blood.
[[nodiscard]] Configuration explore_configuration();

/// The configuration that a request states: `base`, changed by `json`. Throws InputError as `configured` does, and for
/// an instrument that is a file: requests reach no disk.
[[nodiscard]] Configuration requested_configuration(const Configuration& base, const Json& json);

}  // namespace skinfit
