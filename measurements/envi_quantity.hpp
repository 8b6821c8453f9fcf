#pragma once

#include <string_view>

#include "measurements/envi_fields.hpp"
#include "measurements/envi_header.hpp"

namespace skinfit {

/// True for keys of a header whose value says what the values are, as `data units`, `z plot titles` or `measurement`;
/// those of text files are among them.
[[nodiscard]] bool is_envi_quantity_key(std::string_view key);

/// Fills quantity, percent, geometry and what else the header says that the values are, after its gains and scale.
/// Throws InputError as `parse_envi_header`.
void read_envi_quantity(const EnviFields& fields, EnviHeader& header);

}  // namespace skinfit
