#pragma once

#include <Eigen/Core>
#include <span>

#include "fit/configuration.hpp"

namespace skinfit {

/// The covariance of measurement minus model: the noise, independent from wavelength to wavelength, and the model's own
/// smooth departure from real skin. For a departure of standard deviation s and length l between wavelengths d apart
///
///     squared_exponential: s^2 exp(-d^2 / (2 l^2))      matern_3_2: s^2 (1 + sqrt(3) d/l) exp(-sqrt(3) d/l)
///
/// [RASMUSSEN06, Eqs. 4.9, 4.17].
class NoiseModel {
public:
    /// `sigma`: standard uncertainty of each value, one per wavelength, above 0.
    NoiseModel(std::span<const double> wavelength_nm, std::span<const double> sigma,
               const std::optional<Discrepancy>& discrepancy);

    /// The inverse Cholesky factor of the covariance times `changes` (wavelengths x any): white, of unit variance.
    [[nodiscard]] Eigen::MatrixXd whiten(const Eigen::MatrixXd& changes) const;

    /// What the departure does not explain of `differences` between model and measurement, in sigmas of the noise:
    /// differences less the posterior mean of the departure given them, S (K + S)^-1 differences with S the noise and K
    /// the kernel [RASMUSSEN06, Eq. 2.23].
    [[nodiscard]] Eigen::VectorXd unexplained(const Eigen::VectorXd& differences) const;

private:
    Eigen::VectorXd sigma_;
    Eigen::MatrixXd factor_;  // lower Cholesky factor of the covariance; empty where it is diagonal
};

/// That covariance, wavelengths x wavelengths.
[[nodiscard]] Eigen::MatrixXd covariance_of(std::span<const double> wavelength_nm, std::span<const double> sigma,
                                            const std::optional<Discrepancy>& discrepancy);

/// The symmetric square root of the departure's covariance, wavelengths x wavelengths: times independent standard
/// normal numbers, a departure drawn at random.
[[nodiscard]] Eigen::MatrixXd departure_root(std::span<const double> wavelength_nm, const Discrepancy& discrepancy);

}  // namespace skinfit
