#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

/// Chebyshev series on [-1, 1], for the emulator.
namespace skinfit {

/// The zeros of T_count, descending: cos(pi (i + 1/2) / count).
[[nodiscard]] Eigen::ArrayXd chebyshev_nodes(int count);

/// The coefficients of the polynomial through values at the nodes of a tensor grid, as a tensor of the same shape. Both
/// are stored with the last dimension running fastest.
[[nodiscard]] std::vector<double> chebyshev_coefficients(std::span<const double> values, std::span<const int> shape);

}  // namespace skinfit
