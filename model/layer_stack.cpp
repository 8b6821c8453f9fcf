#include "model/layer_stack.hpp"

#include <cassert>

namespace skinfit {

LayerStack layer_stack(const Sample& sample, double wavelength_nm) {
    assert(sample.layers == 2 || sample.layers == 4);
    const PerLayer<double> index = refractive_index(sample.skin);
    const PerLayer<double> thickness = thickness_cm(sample.skin);
    LayerStack stack{.layers = sample.layers,
                     .interface = {},
                     .base = sample.base.kind,
                     .edition = sample.edition,
                     .rayleigh_depth = {},
                     .forward = {ForwardScattering(Layer::stratum_corneum, wavelength_nm),
                                 ForwardScattering(Layer::epidermis, wavelength_nm)},
                     .rayleigh = RayleighScattering(sample.edition)};
    const auto lowest = static_cast<std::size_t>(sample.layers);
    for (std::size_t i = 0; i <= lowest; ++i) {
        const double above = i == 0 ? 1.0 : index[i - 1];
        // At the lowest interface this serves Base::Kind::index alone: the other bases do not ask it.
        const double below = i == lowest ? sample.base.refractive_index : index[i];
        stack.interface[i] = {FresnelInterface(above, below), FresnelInterface(below, above)};
    }
    for (std::size_t layer = 2; layer < lowest; ++layer) {
        stack.rayleigh_depth[layer] =
            rayleigh_optical_depth({.wavelength_nm = wavelength_nm,
                                    .fibre_refractive_index = sample.skin.fibre_refractive_index,
                                    .medium_refractive_index = index[layer],
                                    .fibril_radius_nm = sample.skin.fibril_radius_nm,
                                    .thickness_cm = thickness[layer]});
    }
    return stack;
}

}  // namespace skinfit
