#pragma once

#include "model/skin.hpp"

/// The rules of interfaces that all walks and the angular solver share. Layers are counted from 0 downward; -1 is the
/// outside above, the number of layers what lies below.
namespace skinfit {

/// What a ray meets at an interface.
enum class InterfaceKind {
    fresnel,  ///< reflection and refraction
    mirror,   ///< everything is reflected
    open,     ///< everything goes on untouched
};

/// The interface to `beyond` of a specimen of `layers` layers on `base`. [KA04, Sec. 3.1]
[[nodiscard]] constexpr InterfaceKind interface_kind(Base::Kind base, int layers, int beyond) {
    if (beyond != layers || base == Base::Kind::index) return InterfaceKind::fresnel;
    return base == Base::Kind::matched ? InterfaceKind::open : InterfaceKind::mirror;
}

/// Whether `layer` is dermis or below it.
[[nodiscard]] constexpr bool in_dermis(int layer) {
    return layer >= static_cast<int>(Layer::papillary_dermis);
}

/// Whether a reflection in layer `layer` at the interface to `beyond` counts for `asks_for_rayleigh`: at interface 3, 4
/// or 5 of [KA04, Sec. 3.2], on either side.
[[nodiscard]] constexpr bool bounces(int layer, int beyond) {
    return in_dermis(layer) || in_dermis(beyond);
}

}  // namespace skinfit
