#pragma once

#include "model/chromophores.hpp"
#include "model/emulator.hpp"

namespace skinfit {

/// The optical depths that occur in a domain at one wavelength.
struct DepthBox {
    PerLayer<double> lowest;
    PerLayer<double> highest;  ///< infinite for a layer that the sample does not have: any depth will do

    /// Whether the depth varies by more than rounding, and the sample has the layer.
    [[nodiscard]] bool varies(std::size_t layer) const;
};
[[nodiscard]] DepthBox depth_box(const EmulatorDomain& domain, const Extinction& extinction);

/// The coordinate in which an emulator expands: log(depth + shift) * scale + offset, from -1 to 1 over the box.
struct DepthCoordinate {
    double shift = 1.0;
    double scale = 0.0;  ///< where the depth does not vary
    double offset = 0.0;

    /// Of one layer of `box`.
    DepthCoordinate(const DepthBox& box, std::size_t layer);

    /// The optical depth at `coordinate`; for a layer whose depth varies.
    [[nodiscard]] double depth(double coordinate) const;
};

}  // namespace skinfit
