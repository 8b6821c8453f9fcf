#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/forward_model.hpp"
#include "fit/noise_model.hpp"
#include "fit/prior.hpp"
#include "fit/problem.hpp"

namespace skinfit {

/// What is to be minimised, as a least-squares problem.
struct Misfit {
    Eigen::VectorXd residual;  ///< of the data, whitened, then of the priors
    Eigen::MatrixXd jacobian;  ///< residuals x free parameters

    /// -2 log of the posterior density up to a constant.
    [[nodiscard]] double cost() const { return residual.squaredNorm(); }
};

/// The misfit of one problem as a function of its free parameters, smooth and with exact derivatives.
class Objective {
public:
    /// `model` must have been made for the problem's experiment.
    Objective(const FitProblem& problem, ForwardModel model);

    [[nodiscard]] const FitProblem& problem() const { return *problem_; }
    [[nodiscard]] std::size_t wavelength_count() const { return problem_->wavelength_nm.size(); }
    /// Of `misfit`: one per wavelength and one per prior.
    [[nodiscard]] std::size_t residual_count() const;
    [[nodiscard]] std::size_t free_count() const { return problem_->free.size(); }

    /// The model's reading at each wavelength for values of the free parameters, and its derivatives.
    struct Modelled {
        Eigen::VectorXd reading;         ///< fractions
        Eigen::MatrixXd jacobian;        ///< wavelengths x free parameters
        Eigen::VectorXd standard_error;  ///< of `reading`, Monte Carlo
    };
    [[nodiscard]] Modelled model(std::span<const double> values) const;

    /// The same readings without their derivatives.
    [[nodiscard]] Eigen::VectorXd readings(std::span<const double> values) const;

    /// All residuals at values of the free parameters, and their derivatives: one per wavelength (whitened by the noise
    /// model, weighted, softened by the loss), then one per prior. Whatever minimises or estimates uncertainty uses
    /// this. A residual is infinite where a prior has no density.
    [[nodiscard]] Misfit misfit(std::span<const double> values) const;

    /// (modelled - measured) of a reading, whitened by the noise model: of unit variance where the model is right.
    [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& reading) const;

    /// The same differences less what the discrepancy explains of them: `NoiseModel::unexplained`.
    [[nodiscard]] Eigen::VectorXd unexplained(const Eigen::VectorXd& reading) const;

    /// What small changes of `reading` (wavelengths x any) make of the data's part of `Misfit::residual`.
    [[nodiscard]] Eigen::MatrixXd residual_changes(const Eigen::VectorXd& reading,
                                                   const Eigen::MatrixXd& changes) const;

    /// The sum of the squares of `residuals` at values of the free parameters: without weights, loss and priors.
    [[nodiscard]] double chi2(std::span<const double> values) const;

    /// `Misfit::cost` without the work of derivatives; infinite where a prior has no density.
    [[nodiscard]] double cost(std::span<const double> values) const;

    /// The reading as each batch of the ensemble alone gives it: wavelengths x batches; no columns without an ensemble.
    [[nodiscard]] Eigen::MatrixXd batch_readings(std::span<const double> values) const;

private:
    [[nodiscard]] Eigen::VectorXd readings_of(const Experiment& experiment) const;
    [[nodiscard]] Experiment with(std::span<const double> values) const;

    [[nodiscard]] Eigen::MatrixXd weighted_and_whitened(const Eigen::MatrixXd& changes) const;
    [[nodiscard]] Eigen::VectorXd differences(const Eigen::VectorXd& reading) const;
    void add_priors(const Experiment& experiment, Misfit& misfit) const;

    const FitProblem* problem_;
    NoiseModel noise_;
    ForwardModel model_;
    std::vector<Parameter> parameters_;  // the free ones
};

}  // namespace skinfit
