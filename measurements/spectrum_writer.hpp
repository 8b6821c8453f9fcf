#pragma once

#include <string>
#include <vector>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// The spectra in columns, readable by `read_spectra` and equal to the last bit when it is: comments with what holds
/// for all of them, then `wavelength_nm` and one column each, `<name>_sigma` beside those with uncertainties. Repeats
/// are not written. Throws InputError naming `where` for what columns cannot hold: different wavelengths, different
/// geometries or instruments, names that are no names of columns.
[[nodiscard]] std::string spectra_csv(const std::vector<Spectrum>& spectra, const std::string& where);

/// The same as JSON, which holds everything but line numbers and how the unit was found.
[[nodiscard]] std::string spectra_json(const std::vector<Spectrum>& spectra);

}  // namespace skinfit
