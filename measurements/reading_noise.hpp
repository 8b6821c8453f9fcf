#pragma once

#include "measurements/spectrum.hpp"

namespace skinfit {

/// The standard deviation of a spectrum's noise from reading to reading, by the median departure of a reading from the
/// line through its neighbours: right for noise that is independent from reading to reading, too large where the
/// spectrum itself bends between readings. 0 of fewer than five readings.
[[nodiscard]] double reading_noise(const Spectrum& spectrum);

}  // namespace skinfit
