#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/forward_model.hpp"
#include "fit/problem.hpp"

namespace skinfit {

/// What is to be minimised, as a least-squares problem: cost = residual.squaredNorm(), which is -2 log of the posterior
/// density up to a constant.
struct Misfit {
    Eigen::VectorXd residual;  ///< of the data, whitened, then of the priors
    Eigen::MatrixXd jacobian;  ///< residuals x free parameters
};

/// The misfit of one problem as a function of its free parameters, smooth and with exact derivatives.
class Objective {
public:
    /// `model` must have been made for the problem's experiment.
    Objective(const FitProblem& problem, ForwardModel model);

    [[nodiscard]] const FitProblem& problem() const { return *problem_; }
    [[nodiscard]] std::size_t residual_count() const { return problem_->wavelength_nm.size(); }
    [[nodiscard]] std::size_t free_count() const { return problem_->free.size(); }

    /// The model's reading at each wavelength for values of the free parameters, and its derivatives.
    struct Modelled {
        Eigen::VectorXd reading;         ///< fractions
        Eigen::MatrixXd jacobian;        ///< wavelengths x free parameters
        Eigen::VectorXd standard_error;  ///< of `reading`, Monte Carlo
    };
    [[nodiscard]] Modelled model(std::span<const double> values) const;

    /// All residuals at values of the free parameters, and their derivatives. Whatever minimises or estimates
    /// uncertainty uses this.
    [[nodiscard]] Misfit misfit(std::span<const double> values) const;

    /// (modelled - measured) / sigma of a reading.
    [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& reading) const;

    /// The sum of squared residuals at values of the free parameters.
    [[nodiscard]] double chi2(std::span<const double> values) const;

    /// The reading as each batch of the ensemble alone gives it: wavelengths x batches; no columns without an ensemble.
    [[nodiscard]] Eigen::MatrixXd batch_readings(std::span<const double> values) const;

private:
    [[nodiscard]] Experiment with(std::span<const double> values) const;

    const FitProblem* problem_;
    ForwardModel model_;
    std::vector<Parameter> parameters_;  // the free ones
};

}  // namespace skinfit
