#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/physiological_priors.hpp"
#include "fit/result.hpp"

namespace skinfit {

/// The free parameters (at least one), each over an axis of its own: value, 95 % interval and, where one is published,
/// the range of healthy skin. As SVG by gnuplot. Throws InputError when gnuplot is missing or fails.
[[nodiscard]] std::string interval_picture(const std::vector<FittedParameter>& free);

}  // namespace skinfit
