#pragma once

#include "measurements/spectrum.hpp"

namespace skinfit {

/// The value of `spectrum` at a wavelength from its first to its last: linear between the readings.
[[nodiscard]] double value_at(const Spectrum& spectrum, double at_nm);

}  // namespace skinfit
