#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace skinfit {

/// A node, and its part in the reading of a skin.
struct NodePart {
    std::size_t node;
    double weight;
};

/// The reduced scattering coefficients to trace, per cm, and how each skin's reading follows from theirs.
struct ScatteringNodes {
    std::vector<double> reduced_per_cm;        ///< ascending
    std::vector<std::vector<NodePart>> parts;  ///< per skin; the weights sum to 1
};

/// For skins of these reduced scattering coefficients, per cm, above 0: nodes at most `ratio` apart, above 1, with four
/// of which a skin is interpolated by the cubic in the logarithm; each distinct coefficient itself where these are no
/// more, or without a ratio.
[[nodiscard]] ScatteringNodes scattering_nodes(std::span<const double> reduced_per_cm, std::optional<double> ratio);

}  // namespace skinfit
