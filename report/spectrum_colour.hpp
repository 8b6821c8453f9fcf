#pragma once

#include <optional>
#include <string>

#include "fit/result.hpp"
#include "model/lab.hpp"

namespace skinfit {

/// How a reflectance looks in daylight (D65) to the observer of 1931.
struct SpectrumColour {
    Lab lab;
    std::string hex;  ///< "#rrggbb", cut to what a display can show
    bool is_in_gamut;
    std::optional<double> individual_typology_angle_deg;
};

/// The colours of a fitted spectrum, and how far they are apart.
struct FittedColour {
    SpectrumColour measured;
    SpectrumColour modelled;
    double ciede2000;
};

/// Why a fitted spectrum has no colour; empty where it has one: a reflectance, read from 420 to 680 nm or further.
[[nodiscard]] std::string why_without_colour(const FittedSpectrum& spectrum);

/// The colours of a spectrum that has them.
[[nodiscard]] FittedColour fitted_colour(const FittedSpectrum& spectrum);

}  // namespace skinfit
