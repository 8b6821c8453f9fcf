#pragma once

#include "measurements/envi_fields.hpp"
#include "measurements/envi_header.hpp"

namespace skinfit {

/// Fills what the header says of the numbers: gains, offsets and the scale factor, the quantity, percent, and remarks
/// on keys that may change the values and are not understood. Throws InputError as `parse_envi_header`.
void read_envi_scale(const EnviFields& fields, EnviHeader& header);

}  // namespace skinfit
