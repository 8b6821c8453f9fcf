#pragma once

#include <string_view>
#include <vector>

namespace skinfit {

/// What computes a figure.
enum class FigureKind {
    extinction,      ///< of the pigments, per cm per (g/L), as the model's tables have it; a series is named as one
    spectrum,        ///< reflectance or transmittance by the angular solver: without noise
    goniophotometer  ///< BRDF or BTDF by the analog walk, all wavelengths weighing the same
};

/// What a figure of the paper claims; each is judged by the function of the same name.
enum class Claim {
    falls_with_wavelength,
    darker_in_order,
    w_deepens_in_order,
    close_to_measured,
    measured_within,
    redder_in_order,
    yellower_in_order,
    more_directional_in_order,
    near_lambertian,
};

/// What is the same for all uses of a claim.
struct ClaimInfo {
    Claim claim;
    std::string_view name;
    FigureKind kind;        ///< of the figures that it is about
    bool compares_series;   ///< needs two series at least
    bool needs_measured;    ///< needs a measured spectrum
    std::string_view text;  ///< for tables
};

/// All claims, in the order of `Claim`.
[[nodiscard]] const std::vector<ClaimInfo>& claim_table();

/// The row of one claim.
[[nodiscard]] const ClaimInfo& info(Claim claim);

}  // namespace skinfit
