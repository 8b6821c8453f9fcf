#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/fit_watch.hpp"
#include "fit/forward_model.hpp"
#include "fit/measurement_model.hpp"
#include "fit/noise_model.hpp"
#include "fit/prior.hpp"
#include "fit/problem.hpp"

namespace skinfit {

/// What is to be minimised, as a least-squares problem.
struct Misfit {
    Eigen::VectorXd residual;  ///< of the data, whitened, then of the priors: their scores
    Eigen::MatrixXd jacobian;  ///< residuals x free parameters
    /// What priors on derived quantities add to -cost / 2 for the logarithm of the posterior's density: the logarithm
    /// of the slopes of their scores, up to a constant, for they are densities of those quantities; and its derivative,
    /// empty without priors.
    double log_volume = 0.0;
    Eigen::VectorXd log_volume_slope{};

    /// The posterior's density with respect to the natural coordinates is exp(-cost / 2 + log_volume), up to a factor.
    [[nodiscard]] double cost() const { return residual.squaredNorm(); }
};

/// The misfit of one problem as a function of its free parameters, smooth and with exact derivatives. Readings are
/// those of all measurements, one measurement after the other.
class Objective {
public:
    /// `models`: one per measurement, each made for its experiment. Refers to the problem, which must outlive it. Once
    /// `stop` is requested, whatever evaluates the model throws Cancelled.
    Objective(const FitProblem& problem, const std::vector<ForwardModel>& models, std::stop_token stop = {});
    /// Of a problem with one measurement.
    Objective(const FitProblem& problem, const ForwardModel& model)
        : Objective(problem, std::vector<ForwardModel>{model}) {}

    /// What it was made from.
    [[nodiscard]] const FitProblem& problem() const { return *problem_; }
    [[nodiscard]] const std::vector<MeasurementModel>& models() const { return models_; }
    [[nodiscard]] const std::stop_token& stop() const { return stop_; }
    [[nodiscard]] std::size_t reading_count() const { return static_cast<std::size_t>(first_row_.back()); }
    /// Of `misfit`: one per reading and one per prior.
    [[nodiscard]] std::size_t residual_count() const;
    [[nodiscard]] std::size_t free_count() const { return problem_->free.size(); }

    /// The model's readings for values of the free parameters, their derivatives and standard errors.
    using Modelled = MeasurementModel::Modelled;
    /// Readings of all measurements, one after the other, and their derivatives by the free parameters.
    [[nodiscard]] Modelled model(std::span<const double> values) const;

    /// The same readings without their derivatives.
    [[nodiscard]] Eigen::VectorXd readings(std::span<const double> values) const;

    /// All residuals at values of the free parameters, and their derivatives: one per reading (whitened by the noise
    /// model, weighted, softened by the loss), then one per prior, its score. Whatever minimises or estimates
    /// uncertainty uses this. A residual is infinite where a prior has no density.
    [[nodiscard]] Misfit misfit(std::span<const double> values) const;

    /// The rows of the priors alone.
    [[nodiscard]] Misfit prior_misfit(std::span<const double> values) const;

    /// (modelled - measured) of a reading, whitened by the noise model: of unit variance where the model is right.
    [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& reading) const;

    /// The same differences less what the discrepancy explains of them: `NoiseModel::unexplained`.
    [[nodiscard]] Eigen::VectorXd unexplained(const Eigen::VectorXd& reading) const;

    /// What small changes of `reading` (readings x any) make of the data's part of `Misfit::residual`.
    [[nodiscard]] Eigen::MatrixXd residual_changes(const Eigen::VectorXd& reading,
                                                   const Eigen::MatrixXd& changes) const;

    /// Whether the cost is chi2: there are no weights and no priors, and the loss is that of squares.
    [[nodiscard]] bool minimises_chi2() const;

    /// The sum of the squares of `residuals` at values of the free parameters: without weights, loss and priors.
    [[nodiscard]] double chi2(std::span<const double> values) const;

    /// `Misfit::cost` without the work of derivatives; infinite where a prior has no density.
    [[nodiscard]] double cost(std::span<const double> values) const;

    /// The readings as each batch of the ensembles alone gives them: readings x batches; no columns without ensembles.
    [[nodiscard]] Eigen::MatrixXd batch_readings(std::span<const double> values) const;

private:
    [[nodiscard]] Eigen::MatrixXd weighted_and_whitened(const Eigen::MatrixXd& changes) const;
    [[nodiscard]] Eigen::VectorXd differences(const Eigen::VectorXd& reading) const;
    const FitProblem* problem_;
    std::vector<MeasurementModel> models_;
    std::vector<NoiseModel> noise_;        // one per measurement
    std::vector<Eigen::Index> first_row_;  // of each measurement's readings, and behind the last
    std::stop_token stop_;
};

}  // namespace skinfit
