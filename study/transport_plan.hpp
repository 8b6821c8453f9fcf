#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/json.hpp"
#include "fit/configuration.hpp"
#include "transport/layered_skin.hpp"

/// Cohorts whose spectra the second physics makes: what it takes beside what a cohort says of its skin.
namespace skinfit {

/// A number that is the same in all subjects, or drawn for each: from the prior within the bounds, evenly without one.
struct DrawnNumber {
    std::optional<Prior> prior;
    Bounds bounds;  ///< equal: held

    /// Whether it differs between subjects.
    [[nodiscard]] bool varies() const { return bounds.lower != bounds.upper; }
    /// What a `uniform` number, 0 to 1, makes of it.
    [[nodiscard]] double drawn(double uniform) const;
};

/// What a port may be, mm: from a fibre's to beyond all light; chosen.
inline constexpr Bounds port_diameters_mm = {.lower = 0.1, .upper = 1000.0};

/// How the layered transport makes the spectra of a cohort. The defaults of scattering are those of `LayeredSkin`.
struct TransportPlan {
    DrawnNumber scattering_at_500_nm_per_cm;
    DrawnNumber scattering_power;
    std::optional<double> port_diameter_mm;  ///< of the disc that is lit and of the light that is collected; none: wide
    std::uint64_t photons = 100'000;         ///< per wavelength and trace
};

/// Reads the plan. Throws InputError, naming `where`, for anything unknown and for numbers out of range.
[[nodiscard]] TransportPlan read_transport_plan(const Json& json, const std::string& where);

/// The form that `read_transport_plan` takes, every default filled in.
[[nodiscard]] Json to_json(const TransportPlan& plan);

/// The parameters that the second physics has too: those of `LayeredSkin` by these names, scale and offset.
[[nodiscard]] std::span<const Parameter> transport_parameters();

/// `configuration` with the values of `LayeredSkin` for those parameters.
[[nodiscard]] Configuration with_layered_skin(Configuration configuration);

/// Throws InputError, naming `where`, for a parameter or derived quantity `name` that the second physics has not.
void check_transport_parameter(std::string_view name, const std::string& where);

/// The skin with these values and this scattering; the rest is the default of `LayeredSkin`.
[[nodiscard]] LayeredSkin layered_skin(const Skin& skin, const ScatteringLaw& scattering);

}  // namespace skinfit
