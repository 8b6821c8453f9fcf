#include "transport/scattering_nodes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/erase_repeated.hpp"

namespace skinfit {
namespace {

constexpr std::size_t nodes_of_a_cubic = 4;

ScatteringNodes own_nodes(std::span<const double> reduced_per_cm, std::vector<double> distinct) {
    ScatteringNodes nodes{.reduced_per_cm = std::move(distinct), .parts = {}};
    for (const double reduced : reduced_per_cm) {
        const auto found = std::ranges::lower_bound(nodes.reduced_per_cm, reduced);
        nodes.parts.push_back(
            {{.node = static_cast<std::size_t>(found - nodes.reduced_per_cm.begin()), .weight = 1.0}});
    }
    return nodes;
}

/// Lagrange's weights of the four nodes about `place`, where nodes lie at whole numbers.
std::vector<NodePart> cubic_parts(double place, std::size_t count) {
    const auto below = static_cast<std::size_t>(std::max(0.0, std::floor(place)));
    const std::size_t first = std::min(below > 0 ? below - 1 : 0, count - nodes_of_a_cubic);
    std::vector<NodePart> parts;
    for (std::size_t i = first; i < first + nodes_of_a_cubic; ++i) {
        double weight = 1.0;
        for (std::size_t j = first; j < first + nodes_of_a_cubic; ++j) {
            if (j == i) continue;
            weight *= (place - static_cast<double>(j)) / (static_cast<double>(i) - static_cast<double>(j));
        }
        parts.push_back({.node = i, .weight = weight});
    }
    return parts;
}

}  // namespace

ScatteringNodes scattering_nodes(std::span<const double> reduced_per_cm, std::optional<double> ratio) {
    assert(!reduced_per_cm.empty() && (!ratio || *ratio > 1.0));
    std::vector<double> distinct(reduced_per_cm.begin(), reduced_per_cm.end());
    std::ranges::sort(distinct);
    erase_repeated(distinct);
    if (!ratio) return own_nodes(reduced_per_cm, std::move(distinct));
    const double lowest = std::log(distinct.front());
    const double range = std::log(distinct.back()) - lowest;
    const auto steps = static_cast<std::size_t>(std::ceil(range / std::log(*ratio)));
    const std::size_t count = std::max(nodes_of_a_cubic, steps + 1);
    if (distinct.size() <= count) return own_nodes(reduced_per_cm, std::move(distinct));
    const double step = range / static_cast<double>(count - 1);
    ScatteringNodes nodes;
    for (std::size_t i = 0; i < count; ++i) {
        nodes.reduced_per_cm.push_back(std::exp(lowest + step * static_cast<double>(i)));
    }
    for (const double reduced : reduced_per_cm) {
        nodes.parts.push_back(cubic_parts((std::log(reduced) - lowest) / step, count));
    }
    return nodes;
}

}  // namespace skinfit
