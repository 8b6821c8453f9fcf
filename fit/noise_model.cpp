#include "fit/noise_model.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/input_error.hpp"

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

Eigen::MatrixXd covariance(const Discrepancy& discrepancy, std::span<const double> wavelength_nm) {
    const auto count = static_cast<Index>(wavelength_nm.size());
    return Eigen::MatrixXd::NullaryExpr(count, count, [&](Index a, Index b) {
        return covariance(discrepancy,
                          wavelength_nm[static_cast<std::size_t>(a)] - wavelength_nm[static_cast<std::size_t>(b)]);
    });
}

}  // namespace

NoiseModel::NoiseModel(std::span<const double> wavelength_nm, std::span<const double> sigma,
                       const std::optional<Discrepancy>& discrepancy)
    : sigma_(Eigen::Map<const Eigen::VectorXd>(sigma.data(), static_cast<Index>(sigma.size()))) {
    if (!discrepancy) return;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance_of(wavelength_nm, sigma, discrepancy));
    if (cholesky.info() != Eigen::Success) {
        throw InputError({.where = "discrepancy",
                          .problem = fmt::format("cannot be used with uncertainties down to {:.2g}", sigma_.minCoeff()),
                          .why = "beside them it leaves no difference between neighbouring wavelengths",
                          .remedy = "state larger uncertainties, or a shorter length_nm"});
    }
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

Eigen::MatrixXd covariance_of(std::span<const double> wavelength_nm, std::span<const double> sigma,
                              const std::optional<Discrepancy>& discrepancy) {
    const auto count = static_cast<Index>(wavelength_nm.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    if (discrepancy) matrix = covariance(*discrepancy, wavelength_nm);
    matrix.diagonal() += Eigen::Map<const Eigen::VectorXd>(sigma.data(), count).cwiseAbs2();
    return matrix;
}

Eigen::MatrixXd departure_root(std::span<const double> wavelength_nm, const Discrepancy& discrepancy) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance(discrepancy, wavelength_nm));
    // Wavelengths closer than the length leave eigenvalues that rounding may make negative.
    const Eigen::VectorXd roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    return solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace skinfit
