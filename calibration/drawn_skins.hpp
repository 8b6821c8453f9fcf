#pragma once

#include <cstdint>
#include <vector>

#include "transport/layered_skin.hpp"

/// Skins of the second physics on which quantities of the tissue are calibrated.
namespace skinfit {

/// Skins alike in all that steers light but `scattering`, so that they share traces, and in bilirubin's band.
struct DrawnFamily {
    BilirubinBand bilirubin;
    std::vector<LayeredSkin> skins;
};

/// `families` families of `each` skins, drawn independently and wider than skin varies, on the logarithm unless it says
/// otherwise; all ranges chosen:
///   of each family: stratum corneum 10 to 30 um of index 1.4 to 1.55 (evenly), rest of the epidermis 30 to 120 um,
///   papillary dermis 100 to 400 um, reduced scattering of the subcutis at 500 nm 12 to 25 per cm; bilirubin's band on
///   albumin or as the table has it, in turn;
///   of each skin: reduced scattering at 500 nm 30 to 130 per cm with a power of 0.3 to 1.8 (evenly), melanosomes 0.5
///   to 40 %, blood 0.3 to 15 % of the dermis on average, the papillary fraction over the reticular one log-normal
///   about 1 with 0.4; saturation 0.2 to 0.98 (evenly); bilirubin 0 in each third, else 0.002 to 0.3 g/L.
/// The same for the same seed.
[[nodiscard]] std::vector<DrawnFamily> drawn_families(std::uint64_t families, std::uint64_t each, std::uint64_t seed);

/// What a fit calls so (`tissue_quantities`), of a skin that is known.
[[nodiscard]] double dermal_hemoglobin_umol_per_l(const LayeredSkin& skin);

}  // namespace skinfit
