#pragma once

#include <vector>

#include "fit/settings.hpp"

namespace skinfit {

/// The settings that state the inverse problem: priors, loss, wavelengths left out and weights, discrepancy.
[[nodiscard]] std::vector<Setting> problem_settings();

}  // namespace skinfit
