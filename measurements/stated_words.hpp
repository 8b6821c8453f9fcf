#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/geometry.hpp"
#include "measurements/abscissa.hpp"

/// What only headers and keywords say, beside what `values_stated`, `specular_stated` and `abscissa_stated` read.
namespace skinfit {

/// The words of prose, such as a description or a title, that call the values no shares of light; nothing where there
/// are none. Only words count that can mean nothing else, and none where reflectance or transmittance is named too.
[[nodiscard]] std::optional<std::string> unusable_in_prose(std::string_view prose);

/// How messages say what to do with values that are `quantity`, in the words of the file.
[[nodiscard]] std::string remedy_for(std::string_view quantity);

/// The geometry in words such as `45/0`, `d:8 SCI` or `0°/45°`: the incidence in degrees and, where it follows, the
/// specular state. A sphere seen at 8 degrees is by reciprocity light at 8 degrees collected from all sides.
struct StatedGeometry {
    std::optional<double> incidence_deg;
    std::optional<Specular> specular;
};
/// What a key and its value state of it, as `MEASUREMENT_GEOMETRY` and `45/0`.
[[nodiscard]] StatedGeometry geometry_stated(std::string_view key, std::string_view value);

/// What an abscissa is by a word that stands where its unit belongs: `nm`, `MICROMETERS`, `1/CM`, `THz`; nothing where
/// it is no unit.
[[nodiscard]] std::optional<Abscissa> abscissa_in_unit(std::string_view unit);

/// The wavelengths, nm, that lie in the range of `width` about `number`.
[[nodiscard]] double width_nm(const Abscissa& abscissa, double number, double width);

}  // namespace skinfit
