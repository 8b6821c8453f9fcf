#pragma once

#include <functional>
#include <string>

#include "model/parameters.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// A sample and how it is lit, as exact text: a part of the keys of what is kept. Of the skin it has the parameters for
/// which `counts` holds, but never the folds: they turn the surface reflection without making it more or less.
[[nodiscard]] std::string sample_key(const Sample& sample, double incidence_rad,
                                     const std::function<bool(const ParameterInfo&)>& counts);

}  // namespace skinfit
