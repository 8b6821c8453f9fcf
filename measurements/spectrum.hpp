#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry.hpp"

namespace skinfit {

/// How a spectrum was measured, as far as its file says so.
struct Geometry {
    std::optional<double> incidence_deg{};  ///< to the normal, in [0, 90)
    std::optional<Specular> specular{};
    std::optional<double> viewing_cone_deg{};  ///< half angle about the normal, above 0 to 90
};

/// A comment `key: value` of a file that says nothing about the measurement.
struct FileNote {
    std::size_t line;  ///< counted from 1
    std::string key;
    std::string value;
};

/// A measured spectrum. The three vectors go together: entry i of each belongs to one wavelength.
struct Spectrum {
    std::string name;                   ///< of the specimen: as its file says, else the column chosen, else the file
    std::string source;                 ///< the file it came from
    std::vector<double> wavelength_nm;  ///< at least one, in [100, 10000], ascends strictly
    std::vector<double> value;          ///< fractions in [0, 1.5], one per wavelength
    std::vector<double> sigma;          ///< standard uncertainty of `value`, above 0; empty where not given
    std::optional<Quantity> quantity;   ///< where the file says so
    Geometry geometry;
    std::string unit_rule;                       ///< how the unit of the values was found, in words
    std::vector<FileNote> notes{};               ///< in the order of the file
    std::size_t missing = 0;                     ///< wavelengths of the file without a value
    std::vector<std::vector<double>> repeats{};  ///< readings of the same specimen, each at the same wavelengths
};

}  // namespace skinfit
