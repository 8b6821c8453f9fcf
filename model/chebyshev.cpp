#include "model/chebyshev.hpp"

#include <cassert>

#include "model/constants.hpp"

namespace skinfit {

using Eigen::Index;

Eigen::ArrayXd chebyshev_nodes(int count) {
    assert(count > 0);
    return (pi / count * (Eigen::ArrayXd::LinSpaced(count, 0.0, count - 1.0) + 0.5)).cos();
}

std::vector<double> chebyshev_coefficients(std::span<const double> values, std::span<const int> shape) {
    using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    std::vector<double> tensor(values.begin(), values.end());
    auto inner = static_cast<Index>(tensor.size());
    for (const int count : shape) {
        // Orthogonality of the polynomials over the nodes.
        Eigen::MatrixXd transform(count, count);
        for (int degree = 0; degree < count; ++degree) {
            for (int i = 0; i < count; ++i) {
                transform(degree, i) = (degree == 0 ? 1.0 : 2.0) / count * std::cos(pi * degree * (i + 0.5) / count);
            }
        }
        const Index block_size = inner;
        inner /= count;
        for (Index first = 0; first < static_cast<Index>(tensor.size()); first += block_size) {
            Eigen::Map<Block> block(tensor.data() + first, count, inner);
            block = transform * block;  // Eigen evaluates a product before it assigns
        }
    }
    assert(inner == 1);
    return tensor;
}

}  // namespace skinfit
