#pragma once

#include <optional>
#include <string>

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
    std::string specimen;              ///< `specimen: any text`
};

/// Reads the comments of the form `key: value` with the keys above; any other is for people only. Throws InputError for
/// a key with a value that is not one of its own, and for a key given twice.
[[nodiscard]] Description read_description(const Columns& columns);

}  // namespace skinfit
