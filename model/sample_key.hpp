#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/parameters.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// A sample and how it is lit, as exact text: a part of the keys of what is kept. Of the skin it has the parameters for
/// which `counts` holds, but never the folds: they turn the surface reflection without making it more or less.
[[nodiscard]] std::string sample_key(const Sample& sample, double incidence_rad,
                                     const std::function<bool(const ParameterInfo&)>& counts);

/// The bytes of this program, hashed: a part of the same keys, so that what another version of it has kept is never
/// taken for its own.
[[nodiscard]] std::uint64_t program_fingerprint();

}  // namespace skinfit
