#pragma once

#include <cstddef>

#include "model/skin.hpp"

namespace skinfit {

/// Sums over some of the paths that leave a sample through one side.
struct PathSums {
    double weight = 0.0;               ///< sum of exp(-depth . length): the number expected to survive
    PerLayer<double> weight_length{};  ///< sum of weight times length, per layer

    PathSums& operator+=(const PathSums& other);
};

/// Where the path lengths lie: layer l of path i at `first[l * stride + i]`, dimensionless multiples of the layer's
/// thickness.
struct PathSpan {
    const float* first;
    std::size_t stride;
    std::size_t count;
};

/// Sums over `paths` for the layers' optical depths, by vector instructions of the machine it runs on. The result
/// depends on nothing but the arguments and the width of those instructions.
[[nodiscard]] PathSums sum_paths(const PathSpan& paths, const PerLayer<double>& optical_depth);

}  // namespace skinfit
