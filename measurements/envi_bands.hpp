#pragma once

#include "measurements/envi_fields.hpp"
#include "measurements/envi_header.hpp"

namespace skinfit {

/// Fills what the header says of the bands: wavelengths and widths in nm, their unit, and which are good. Throws
/// InputError as `parse_envi_header`.
void read_envi_bands(const EnviFields& fields, EnviHeader& header);

}  // namespace skinfit
