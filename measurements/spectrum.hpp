#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry.hpp"

namespace skinfit {

/// How a spectrum was measured, as far as its file says so.
struct Geometry {
    std::optional<double> incidence_deg;  ///< to the normal
    std::optional<Specular> specular;
};

/// A measured spectrum.
struct Spectrum {
    std::string name;                   ///< of the specimen: the column, or the file where there is one column
    std::string source;                 ///< the file it came from
    std::vector<double> wavelength_nm;  ///< ascends strictly
    std::vector<double> value;          ///< fractions, one per wavelength
    std::vector<double> sigma;          ///< standard uncertainty of `value`, one per wavelength; empty where not given
    std::optional<Quantity> quantity;   ///< where the file says so
    Geometry geometry;
    std::string unit_rule;  ///< how the unit of the values was found, in words
};

}  // namespace skinfit
