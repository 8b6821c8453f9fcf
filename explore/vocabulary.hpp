#pragma once

#include "fit/settings.hpp"

namespace skinfit {

/// What the page knows of the model: each parameter with its group, unit, ranges and default; the settings' schema and
/// defaults; the names of layers and instruments; which settings a measured file decides, which engines fit, and how
/// much a page may send.
[[nodiscard]] Json vocabulary_json();

}  // namespace skinfit
