#pragma once

#include <span>
#include <string>

#include "model/lab.hpp"
#include "validation/curve.hpp"
#include "validation/finding.hpp"

/// Claims about the colours of spectra: pure functions of the colours.
namespace skinfit {

/// How a spectrum looks in daylight (D65, the observer of 1931).
struct RenderedColour {
    Lab lab;
    std::string srgb;          ///< "#rrggbb"
    bool is_in_gamut = false;  ///< a display shows it; else `srgb` is the nearest it can
};

/// Throws InputError where the curve does not span 420 to 680 nm.
[[nodiscard]] RenderedColour rendered(const SpectralCurve& curve);

/// a* rises from every colour, two at least, to the next, and the rise of a* alone from the first to the last is a
/// colour difference that can just be seen, CIEDE2000 of 1 or more. [SHARMA05]
[[nodiscard]] ClaimFinding redder_in_order(std::span<const Lab> colours);

/// The same of b*.
[[nodiscard]] ClaimFinding yellower_in_order(std::span<const Lab> colours);

}  // namespace skinfit
