#include "fit/noise_model.hpp"

#include <Eigen/Cholesky>
#include <cassert>
#include <cmath>

namespace skinfit {
namespace {

using Index = Eigen::Index;

double covariance(const Discrepancy& discrepancy, double distance_nm) {
    const double variance = discrepancy.sigma * discrepancy.sigma;
    const double lengths = std::abs(distance_nm) / discrepancy.length_nm;
    if (discrepancy.kernel == Kernel::squared_exponential) return variance * std::exp(-0.5 * lengths * lengths);
    const double steps = std::sqrt(3.0) * lengths;
    return variance * (1.0 + steps) * std::exp(-steps);
}

}  // namespace

NoiseModel::NoiseModel(std::span<const double> wavelength_nm, std::span<const double> sigma,
                       const std::optional<Discrepancy>& discrepancy)
    : sigma_(Eigen::Map<const Eigen::VectorXd>(sigma.data(), static_cast<Index>(sigma.size()))) {
    if (!discrepancy) return;
    Eigen::MatrixXd matrix = sigma_.cwiseAbs2().asDiagonal();
    for (Index a = 0; a < matrix.rows(); ++a) {
        for (Index b = 0; b < matrix.cols(); ++b) {
            matrix(a, b) += covariance(
                *discrepancy, wavelength_nm[static_cast<std::size_t>(a)] - wavelength_nm[static_cast<std::size_t>(b)]);
        }
    }
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    // A kernel is positive and the noise keeps it well away from singular.
    assert(cholesky.info() == Eigen::Success);
    factor_ = cholesky.matrixL();
}

Eigen::MatrixXd NoiseModel::whiten(const Eigen::MatrixXd& changes) const {
    if (factor_.size() == 0) return sigma_.cwiseInverse().asDiagonal() * changes;
    return factor_.triangularView<Eigen::Lower>().solve(changes);
}

Eigen::VectorXd NoiseModel::unexplained(const Eigen::VectorXd& differences) const {
    if (factor_.size() == 0) return sigma_.cwiseInverse().asDiagonal() * differences;
    const Eigen::VectorXd whitened = factor_.triangularView<Eigen::Lower>().solve(differences);
    return sigma_.asDiagonal() * factor_.triangularView<Eigen::Lower>().transpose().solve(whitened);
}

}  // namespace skinfit
