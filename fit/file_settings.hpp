#pragma once

#include "fit/configuration.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// `configuration` with the edition, layers and base that the comments of the measured file state, as those of
/// simulated files do. Throws InputError for a value that cannot be used and for a key stated twice. The seed is not
/// taken: a fit with the random numbers of the simulation would not see its noise.
[[nodiscard]] Configuration with_file_settings(Configuration configuration, const Spectrum& spectrum);

}  // namespace skinfit
