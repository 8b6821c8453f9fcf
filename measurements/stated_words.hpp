#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/geometry.hpp"

/// What titles, units and names of files say about a measurement, in the words that instruments use.
namespace skinfit {

/// The quantity that a title, a unit or a name states for its values, such as `Reflection (%)` or `%T`; nothing where
/// it names neither or both.
[[nodiscard]] std::optional<Quantity> quantity_in_title(std::string_view title);

/// The word in a title or unit for a quantity that is no share of light, such as `absorbance`, `log(1/R)`, `counts`;
/// nothing where there is none.
[[nodiscard]] std::optional<std::string> unusable_quantity(std::string_view title);

/// The same for prose, in which only words that can mean nothing else count, and none where reflectance or
/// transmittance is named too.
[[nodiscard]] std::optional<std::string> unusable_quantity_in_prose(std::string_view prose);

/// How messages say what to do with values that are `quantity`.
[[nodiscard]] std::string remedy_for(std::string_view quantity);

/// True where a title or unit says percent.
[[nodiscard]] bool says_percent(std::string_view title);

/// The specular state that a name, title or keyword states: SCI and SCE and what they stand for.
[[nodiscard]] std::optional<Specular> specular_in_title(std::string_view title);

/// The geometry in words such as `45/0`, `d:8 SCI` or `0°/45°`: the incidence in degrees and, where it follows, the
/// specular state. A sphere seen at 8 degrees is by reciprocity light at 8 degrees collected from all sides.
struct StatedGeometry {
    std::optional<double> incidence_deg;
    std::optional<Specular> specular;
};
[[nodiscard]] StatedGeometry geometry_in_title(std::string_view title);

/// The unit of an abscissa: wavelengths in nm are `factor` times the number, or `factor` over it.
struct AbscissaUnit {
    double factor;
    bool reciprocal;  ///< of frequencies, wavenumbers and energies
    std::string_view name;

    [[nodiscard]] double wavelength_nm(double number) const { return reciprocal ? factor / number : factor * number; }
    /// The wavelengths that lie in the range of `width` about `number`.
    [[nodiscard]] double width_nm(double number, double width) const;
};

/// The unit that a word or title such as `nm`, `Wavelength [um]`, `1/CM` or `THz` states; nothing where it states none
/// or several.
[[nodiscard]] std::optional<AbscissaUnit> abscissa_unit(std::string_view title);

}  // namespace skinfit
