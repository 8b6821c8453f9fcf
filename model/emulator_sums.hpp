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

/// The Chebyshev series of a group: for each triple of degrees in the first three layers, the last degree running
/// fastest, so many terms in the last layer; the coefficients of all terms in that order, those of the wavelengths of
/// the group side by side.
struct EmulatorSeries {
    std::array<int, 3> counts;  ///< of degrees in stratum corneum, epidermis, papillary dermis
    std::span<const std::uint8_t> terms;
    std::span<const float> coefficients;
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
