#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurements/columns.hpp"
#include "measurements/spectrum.hpp"
#include "measurements/unit_rule.hpp"

namespace skinfit {

/// What the comments of a file say about its measurement.
struct Description {
    std::optional<Quantity> quantity;  ///< `quantity: reflectance` or `transmittance`
    std::optional<Unit> unit;          ///< `unit: fraction` or `percent`
    /// `incidence_deg: 45`, `specular: included` or `excluded`, `viewing_cone_deg: 5`
    Geometry geometry;
    std::string specimen;         ///< `specimen: any text`
    std::vector<FileNote> notes;  ///< all other comments of the form `key: value`
};

/// Reads the comments of the form `key: value` with the keys above. Throws InputError for a key with a value that is
/// not one of its own, for a key given twice, and for a key that looks like a slip of one that changes what is read.
[[nodiscard]] Description read_description(const Columns& columns);

}  // namespace skinfit
