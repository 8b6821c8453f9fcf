#pragma once

#include <string>
#include <vector>

#include "model/spectrophotometer.hpp"

namespace skinfit {

/// Where the light goes, as shares of the incident light that add up to 1.
struct LightShares {
    double wavelength_nm;  ///< as the instrument states it
    double surface;        ///< reflected by the surface
    double reflected;      ///< left through the surface after having entered
    double transmitted;    ///< left through the base
    PerLayer<double> absorbed;

    bool operator==(const LightShares&) const = default;
};

/// The shares at up to 61 wavelengths spread evenly from the first to the last of `wavelength_nm`, or at these where
/// they are no more. Computed by the angular solver, into all directions, whatever an instrument sees of them, and
/// without its bandpass.
[[nodiscard]] std::vector<LightShares> light_budget(const Experiment& experiment,
                                                    const std::vector<double>& wavelength_nm);

/// One share of the budget over all its wavelengths, and how it is called and drawn.
struct LightFate {
    std::string name;
    std::string colour;  ///< "#rrggbb"
    std::vector<double> share;
};

/// The shares by what becomes of the light, those that are nowhere above 0 left out: absorbed in each layer, top to
/// bottom, transmitted, reflected from below the surface, reflected by the surface.
[[nodiscard]] std::vector<LightFate> light_fates(const std::vector<LightShares>& budget);

/// The shares over wavelength, stacked, as SVG by gnuplot. Throws InputError when gnuplot is missing or fails.
[[nodiscard]] std::string light_picture(const std::vector<LightShares>& budget);

}  // namespace skinfit
