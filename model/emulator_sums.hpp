#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "model/skin.hpp"

namespace skinfit {

/// Wavelengths are emulated in groups of this many, side by side in vector registers.
inline constexpr std::size_t emulator_lanes = 16;
/// The most polynomials of one variable.
inline constexpr int most_emulator_terms = 40;

/// One value for each wavelength of a group.
template <class Value>
using Lanes = std::array<Value, emulator_lanes>;

/// The coordinate of one layer in which the share is a polynomial: log(depth + shift) * scale + offset, -1 to 1.
struct EmulatorCoordinate {
    PerLayer<Lanes<double>> shift;
    PerLayer<Lanes<double>> scale;
    PerLayer<Lanes<double>> offset;
};

/// The Chebyshev series of a group, without its smallest terms. The degrees in the four layers are nested loops, that
/// of the first layer outermost; a loop ends with the last degree that has a term.
struct EmulatorSeries {
    PerLayer<int> most;                    ///< the longest loop of each layer
    std::span<const std::uint8_t> counts;  ///< the length of each loop, in the order in which the loops are entered
    std::span<const float> coefficients;   ///< of all terms in their order; the wavelengths of the group side by side
};

/// A series and its derivative by each layer's optical depth, per wavelength.
struct EmulatorSums {
    Lanes<double> value;
    PerLayer<Lanes<double>> by_optical_depth;
};

/// The series at the layers' optical depths, by vector instructions of the machine it runs on. The result depends on
/// nothing but the arguments and the width of those instructions.
[[nodiscard]] EmulatorSums sum_series(const EmulatorSeries& series, const EmulatorCoordinate& coordinate,
                                      const PerLayer<Lanes<double>>& optical_depth);

}  // namespace skinfit
