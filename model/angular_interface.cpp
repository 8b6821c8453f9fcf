#include "model/angular_interface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/erase_repeated.hpp"
#include "model/angular_basis.hpp"

namespace skinfit {
namespace {

/// A cosine that moves with the ratio of the indices.
struct Moving {
    double value;
    double by_ratio;
};

/// The cosine on this side of rays that have cosine `beyond` on the other side, by Snell's law.
Moving image(double beyond, double ratio) {
    const double sine_squared = (1.0 - beyond) * (1.0 + beyond) / (ratio * ratio);
    const double cosine = std::sqrt(1.0 - sine_squared);
    return {.value = cosine, .by_ratio = sine_squared / (ratio * cosine)};
}

/// The critical cosine; 0 where there is none.
Moving critical_cosine(const InterfaceSide& side) {
    if (side.kind != InterfaceKind::fresnel || side.ratio <= 1.0) return {.value = 0.0, .by_ratio = 0.0};
    return image(0.0, side.ratio);
}

std::vector<Moving> piece_ends(const InterfaceSide& side) {
    std::vector<Moving> ends = {{0.0, 0.0}, {1.0, 0.0}, critical_cosine(side)};
    for (const double edge : side.edges_here) ends.push_back({edge, 0.0});
    if (side.kind == InterfaceKind::fresnel) {
        for (const double edge : side.edges_beyond) {
            if (edge < 1.0 && (1.0 - edge) * (1.0 + edge) < side.ratio * side.ratio) {
                ends.push_back(image(edge, side.ratio));
            }
        }
    }
    // Of two ends that meet, the one that moves is kept: the derivatives follow it.
    std::ranges::sort(ends, [](const Moving& a, const Moving& b) {
        return a.value < b.value || (a.value == b.value && a.by_ratio > b.by_ratio);
    });
    erase_repeated(ends, &Moving::value);
    return ends;
}

/// Cosine beyond and reflectance of the nodes that are not totally reflected.
void refract(InterfaceNodes& nodes, double ratio, const Moving& critical, const Eigen::ArrayXd& above_critical,
             const Eigen::ArrayXd& above_critical_by_ratio) {
    const Eigen::ArrayXd here = nodes.cosine.tail(nodes.transmitting);
    const Eigen::ArrayXd here_by_ratio = nodes.cosine_by_ratio.tail(nodes.transmitting);
    if (ratio <= 1.0) {
        const Eigen::ArrayXd sine_squared = 1.0 - here.square();
        // Snell's law without cancellation where both cosines are small
        nodes.refracted = ((1.0 - ratio) * (1.0 + ratio) + ratio * ratio * here.square()).sqrt();
        nodes.refracted_by_ratio = (ratio * ratio * here * here_by_ratio - ratio * sine_squared) / nodes.refracted;
    } else {
        // The same, without cancellation where it is zero: 1 - ratio^2 = -ratio^2 critical^2
        const Eigen::ArrayXd sum = here + critical.value;
        nodes.refracted = ratio * (above_critical * sum).sqrt();
        nodes.refracted_by_ratio = nodes.refracted * (1.0 / ratio + 0.5 * (above_critical_by_ratio / above_critical +
                                                                           (here_by_ratio + critical.by_ratio) / sum));
    }
    const Eigen::ArrayXd& beyond = nodes.refracted;
    const Eigen::ArrayXd& beyond_by_ratio = nodes.refracted_by_ratio;
    const Eigen::ArrayXd a = ratio * here;
    const Eigen::ArrayXd a_by_ratio = here + ratio * here_by_ratio;
    const Eigen::ArrayXd b = ratio * beyond;
    const Eigen::ArrayXd b_by_ratio = beyond + ratio * beyond_by_ratio;
    const Eigen::ArrayXd perpendicular = (a - beyond) / (a + beyond);
    const Eigen::ArrayXd parallel = (here - b) / (here + b);
    nodes.reflectance.tail(nodes.transmitting) = 0.5 * (perpendicular.square() + parallel.square());
    nodes.reflectance_by_ratio.tail(nodes.transmitting) =
        2.0 * (perpendicular * (a_by_ratio * beyond - a * beyond_by_ratio) / (a + beyond).square() +
               parallel * (here_by_ratio * b - here * b_by_ratio) / (here + b).square());
}

/// The rule for a piece: Gauss's, with nodes crowded at its begin like a power of a uniform number.
Quadrature piece_rule(const NodeCounts& counts, int power) {
    const int exact = (power * (counts.degree + 1) + 1) / 2;
    Quadrature rule = gauss_legendre(std::max(exact, power > 1 ? counts.crowded : counts.regular));
    rule.weight *= power * rule.node.pow(power - 1);
    rule.node = rule.node.pow(power);
    return rule;
}

/// The nodes of all pieces, and their cosines above the critical one; what happens to the light there is left open.
struct PlacedNodes {
    InterfaceNodes nodes;
    Eigen::ArrayXd above_critical;
    Eigen::ArrayXd above_critical_by_ratio;
};

PlacedNodes placed_nodes(const std::vector<Moving>& ends, const Moving& critical, const NodeCounts& counts) {
    const Quadrature regular = piece_rule(counts, 1);
    const Quadrature at_critical = piece_rule(counts, 2);
    const Quadrature grazing = piece_rule(counts, 3);
    std::vector<const Quadrature*> rules;
    Eigen::Index count = 0;
    for (auto low = ends.begin(); low + 1 != ends.end(); ++low) {
        const bool critical_piece = low->value == critical.value;
        rules.push_back(low == ends.begin() ? &grazing : critical_piece ? &at_critical : &regular);
        count += rules.back()->node.size();
    }
    PlacedNodes placed{.nodes = {.cosine = Eigen::ArrayXd(count),
                                 .weight = Eigen::ArrayXd(count),
                                 .reflectance = Eigen::ArrayXd::Ones(count),
                                 .refracted = {},
                                 .cosine_by_ratio = Eigen::ArrayXd(count),
                                 .weight_by_ratio = Eigen::ArrayXd(count),
                                 .reflectance_by_ratio = Eigen::ArrayXd::Zero(count),
                                 .refracted_by_ratio = {},
                                 .transmitting = 0},
                       .above_critical = Eigen::ArrayXd(count),
                       .above_critical_by_ratio = Eigen::ArrayXd(count)};
    InterfaceNodes& nodes = placed.nodes;
    Eigen::Index first = 0;
    for (std::size_t i = 0; i < rules.size(); ++i) {
        const Moving low = ends[i];
        const Moving width = {ends[i + 1].value - low.value, ends[i + 1].by_ratio - low.by_ratio};
        const Quadrature& rule = *rules[i];
        const Eigen::Index points = rule.node.size();
        nodes.cosine.segment(first, points) = low.value + width.value * rule.node;
        nodes.cosine_by_ratio.segment(first, points) = low.by_ratio + width.by_ratio * rule.node;
        nodes.weight.segment(first, points) = width.value * rule.weight;
        nodes.weight_by_ratio.segment(first, points) = width.by_ratio * rule.weight;
        placed.above_critical.segment(first, points) = (low.value - critical.value) + width.value * rule.node;
        placed.above_critical_by_ratio.segment(first, points) =
            (low.by_ratio - critical.by_ratio) + width.by_ratio * rule.node;
        if (low.value >= critical.value) nodes.transmitting += points;
        first += points;
    }
    return placed;
}

}  // namespace

InterfaceNodes interface_nodes(const InterfaceSide& side, const NodeCounts& counts) {
    const Moving critical = critical_cosine(side);
    PlacedNodes placed = placed_nodes(piece_ends(side), critical, counts);
    InterfaceNodes& nodes = placed.nodes;
    if (side.kind == InterfaceKind::mirror) {
        nodes.transmitting = 0;
    } else if (side.kind == InterfaceKind::open) {
        nodes.transmitting = nodes.cosine.size();
        nodes.reflectance.setZero();
        nodes.refracted = nodes.cosine;
        nodes.refracted_by_ratio = nodes.cosine_by_ratio;
    } else {
        refract(nodes, side.ratio, critical, placed.above_critical.tail(nodes.transmitting),
                placed.above_critical_by_ratio.tail(nodes.transmitting));
    }
    return std::move(placed.nodes);
}

}  // namespace skinfit
