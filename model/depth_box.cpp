#include "model/depth_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skinfit {

bool DepthBox::varies(std::size_t layer) const {
    constexpr double rounding = 1e-9;
    return highest[layer] > lowest[layer] * (1.0 + rounding) && std::isfinite(highest[layer]);
}

DepthBox depth_box(const EmulatorDomain& domain, const Extinction& extinction) {
    // A depth rises or falls with each parameter by itself, so its extremes lie at corners of the ranges.
    DepthBox box;
    box.lowest.fill(std::numeric_limits<double>::infinity());
    box.highest.fill(0.0);
    for (std::size_t corner = 0; corner < std::size_t{1} << domain.ranges.size(); ++corner) {
        ParameterValues values{.skin = domain.sample.skin, .instrument = {}};
        for (std::size_t i = 0; i < domain.ranges.size(); ++i) {
            const ParameterRange& range = domain.ranges[i];
            value_of(values, range.parameter) = (corner >> i) % 2 == 0 ? range.lower : range.upper;
        }
        const PerLayer<double> depth = optical_depth(values.skin, extinction);
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            box.lowest[layer] = std::min(box.lowest[layer], depth[layer]);
            box.highest[layer] = std::max(box.highest[layer], depth[layer]);
        }
    }
    for (auto layer = static_cast<std::size_t>(domain.sample.layers); layer < layer_count; ++layer) {
        box.lowest[layer] = 0.0;
        box.highest[layer] = std::numeric_limits<double>::infinity();
    }
    return box;
}

DepthCoordinate::DepthCoordinate(const DepthBox& box, std::size_t layer) {
    if (!box.varies(layer)) return;
    // Of a layer that may not absorb at all a thousandth of its greatest depth; chosen, its error is certified as any.
    shift = box.lowest[layer] > 0.0 ? 2.0 * box.lowest[layer] : 1e-3 * box.highest[layer];
    const double first = std::log(box.lowest[layer] + shift);
    const double last = std::log(box.highest[layer] + shift);
    scale = 2.0 / (last - first);
    offset = -1.0 - first * scale;
}

double DepthCoordinate::depth(double coordinate) const {
    return std::exp((coordinate - offset) / scale) - shift;
}

}  // namespace skinfit
