#pragma once

#include <array>
#include <optional>

#include "model/lab.hpp"
#include "study/studied_spectrum.hpp"

namespace skinfit {

/// The probability of each class of skin colour.
using ColourClassProbabilities = std::array<double, skin_colour_count>;

/// By the individual typology angle of a spectrum and its standard deviation, normal; they add up to 1. None for a
/// spectrum without the angle.
[[nodiscard]] std::optional<ColourClassProbabilities> colour_classes_of(const StudiedSpectrum& spectrum);

}  // namespace skinfit
