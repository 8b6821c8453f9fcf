#pragma once

#include <string>
#include <vector>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// The spectrum of `spectra` called `wanted`, else the one with that number, counted from 1; where names are
/// numbers, only they count. `source` names their file in messages. Throws InputError when there is none or several
/// have the name.
[[nodiscard]] Spectrum choose_spectrum(std::vector<Spectrum> spectra, const std::string& source,
                                       const std::string& wanted);

/// The names of the first twenty, and how many more there are.
[[nodiscard]] std::string list_of_names(const std::vector<Spectrum>& spectra);

}  // namespace skinfit
