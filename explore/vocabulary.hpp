#pragma once

#include "fit/settings.hpp"

namespace skinfit {

/// What the page knows of the model: each parameter with its group, unit, ranges and default; the settings' schema and
/// defaults; the names of layers and instruments.
[[nodiscard]] Json vocabulary_json();

}  // namespace skinfit
