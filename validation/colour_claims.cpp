#include "validation/colour_claims.hpp"

#include <fmt/format.h>

#include <cassert>
#include <string_view>

#include "model/colour.hpp"
#include "model/colour_difference.hpp"
#include "model/srgb.hpp"

namespace skinfit {
namespace {

/// About the smallest CIEDE2000 that is seen.
constexpr double just_noticeable = 1.0;

ClaimFinding rising_in_order(std::span<const Lab> colours, double Lab::*coordinate, std::string_view name) {
    assert(colours.size() >= 2);
    bool rises = true;
    for (std::size_t i = 1; i < colours.size(); ++i) rises &= colours[i].*coordinate > colours[i - 1].*coordinate;
    const Lab& first = colours.front();
    const Lab& last = colours.back();
    Lab shifted = first;
    shifted.*coordinate = last.*coordinate;
    const double alone = ciede2000(first, shifted);
    const bool is_seen = alone >= just_noticeable;
    return {
        .verdict = verdict_of(rises && is_seen),
        .number = last.*coordinate - first.*coordinate,
        .measure = fmt::format("change of {} from first to last; CIEDE2000 of it alone >= {}", name, just_noticeable),
        .why = fmt::format("{} goes from {:.1f} to {:.1f}{}, alone a CIEDE2000 of {:.1f}; L* goes from {:.1f} to "
                           "{:.1f}",
                           name, first.*coordinate, last.*coordinate, rises ? " step by step" : ", not at every step",
                           alone, first.l, last.l)};
}

}  // namespace

RenderedColour rendered(const SpectralCurve& curve) {
    const SeenColour seen = colour_of({.wavelength_nm = curve.wavelength_nm, .value = curve.value}, Viewing{});
    const Rgb encoded = encoded_srgb(linear_srgb(seen.xyz, seen.white));
    return {.lab = lab_from_xyz(seen.xyz, seen.white),
            .srgb = hex_string(clipped_to_srgb_gamut(encoded)),
            .is_in_gamut = in_srgb_gamut(encoded)};
}

ClaimFinding redder_in_order(std::span<const Lab> colours) {
    return rising_in_order(colours, &Lab::a, "a*");
}

ClaimFinding yellower_in_order(std::span<const Lab> colours) {
    return rising_in_order(colours, &Lab::b, "b*");
}

}  // namespace skinfit
