#pragma once

#include "model/random_walk.hpp"

namespace skinfit {

/// Follows one ray that arrives with `incidence_cosine`, testing it for absorption run by run, and counts how it ends.
/// A ray that leaves has its direction in `walk` afterwards.
template <class Walk>
Exit follow_analog(Walk& walk, const PerLayer<double>& optical_depth, double incidence_cosine, WalkCounts& counts) {
    ++counts.rays;
    const auto first = walk.first_hit(incidence_cosine);
    if (first.reflected) {
        ++counts.surface_reflected;
        return Exit::surface;
    }
    std::size_t last_layer = 0;
    const Exit exit = walk.below_surface(first.refracted_cosine, [&](int layer, double cosine, double xi) {
        last_layer = static_cast<std::size_t>(layer);
        return xi < std::exp(-optical_depth[last_layer] / cosine);  // [KA04, Eq. 5]
    });
    switch (exit) {
        case Exit::reflected:
            ++counts.subsurface_reflected;
            break;
        case Exit::transmitted:
            ++counts.transmitted;
            break;
        default:
            ++counts.absorbed[last_layer];
            break;
    }
    return exit;
}

}  // namespace skinfit
