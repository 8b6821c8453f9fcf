#pragma once

#include <span>

#include "fit/configuration.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// `configuration` with what it leaves unset of edition, layers and base as the files' comments state it, as a
/// simulated spectrum does. Throws InputError for a word that is none of theirs, for a key given twice and for files
/// that contradict each other.
[[nodiscard]] Configuration with_file_settings(const Configuration& configuration, std::span<const Spectrum> spectra);

}  // namespace skinfit
