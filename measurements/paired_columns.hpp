#pragma once

#include <cstddef>
#include <vector>

#include "measurements/columns.hpp"

namespace skinfit {

/// The columns of wavelengths of a table in which none is called after them, but in which each second column has its
/// own before it: `x1,y1,x2,y2`, or numbers that ascend or descend within 200 to 2500 in these columns alone. Empty for
/// other tables.
[[nodiscard]] std::vector<std::size_t> every_other_column(const Columns& columns);

}  // namespace skinfit
