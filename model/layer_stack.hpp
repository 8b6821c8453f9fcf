#pragma once

#include <array>

#include "model/fresnel.hpp"
#include "model/scattering.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// Everything that steers a ray of one wavelength through a sample. Pigments do not; nor do the thicknesses of
/// stratum corneum and epidermis.
struct LayerStack {
    int layers;                                                              ///< 2 or 4
    std::array<std::array<FresnelInterface, 2>, layer_count + 1> interface;  ///< top to bottom; from above, from below
    Base::Kind base;                                                         ///< what the lowest interface does
    Edition edition;                                                         ///< which Rayleigh rules hold
    PerLayer<double> rayleigh_depth;                                         ///< at normal passage; dermis only
    std::array<ForwardScattering, 2> forward;                                ///< stratum corneum, epidermis
    RayleighScattering rayleigh;                                             ///< angles in the dermis

    /// The interface between neighbouring layers as a ray that goes from one to the other sees it; -1 is the air and
    /// `layers` the base.
    [[nodiscard]] const FresnelInterface& between(int from, int to) const {
        return from < to ? interface[static_cast<std::size_t>(to)][0] : interface[static_cast<std::size_t>(from)][1];
    }
};

/// The stack of `sample` at `wavelength_nm`.
[[nodiscard]] LayerStack layer_stack(const Sample& sample, double wavelength_nm);

}  // namespace skinfit
