#include "fit/objective.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "fit/loss.hpp"

namespace skinfit {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Objective::Objective(const FitProblem& problem, const std::vector<ForwardModel>& models, std::stop_token stop)
    : problem_(&problem), first_row_{0}, stop_(std::move(stop)) {
    assert(models.size() == problem.measurements.size());
    for (std::size_t k = 0; k < models.size(); ++k) {
        const Measurement& measurement = problem.measurements[k];
        models_.emplace_back(problem, k, models[k]);
        noise_.emplace_back(measurement.wavelength_nm, measurement.sigma, problem.discrepancy);
        first_row_.push_back(first_row_.back() + static_cast<Index>(measurement.wavelength_nm.size()));
    }
}

Objective::Modelled Objective::model(std::span<const double> values) const {
    leave_if_cancelled(stop_);
    if (models_.size() == 1) return models_.front().model(values);
    const Index rows = first_row_.back();
    Modelled all{.reading = VectorXd(rows),
                 .jacobian = MatrixXd(rows, static_cast<Index>(free_count())),
                 .standard_error = VectorXd(rows)};
    for (std::size_t k = 0; k < models_.size(); ++k) {
        const Modelled part = models_[k].model(values);
        const Index first = first_row_[k];
        all.reading.segment(first, part.reading.size()) = part.reading;
        all.jacobian.middleRows(first, part.reading.size()) = part.jacobian;
        all.standard_error.segment(first, part.reading.size()) = part.standard_error;
    }
    return all;
}

VectorXd Objective::readings(std::span<const double> values) const {
    leave_if_cancelled(stop_);
    VectorXd all(first_row_.back());
    for (std::size_t k = 0; k < models_.size(); ++k) {
        all.segment(first_row_[k], first_row_[k + 1] - first_row_[k]) = models_[k].readings(values);
    }
    return all;
}

std::size_t Objective::residual_count() const {
    const auto on_parameters =
        std::ranges::count_if(problem_->free, [](const FreeParameter& free) { return free.prior.has_value(); });
    return reading_count() + static_cast<std::size_t>(on_parameters) + problem_->derived_priors.size();
}

Misfit Objective::misfit(std::span<const double> values) const {
    const Modelled modelled = model(values);
    const auto rows = static_cast<Index>(reading_count());
    const auto all_rows = static_cast<Index>(residual_count());
    const VectorXd hard = weighted_and_whitened(differences(modelled.reading));
    Misfit misfit{.residual = VectorXd(all_rows), .jacobian = MatrixXd(all_rows, modelled.jacobian.cols())};
    for (Index row = 0; row < rows; ++row) {
        misfit.residual[row] = softened(hard[row], problem_->loss, problem_->loss_scale).value;
    }
    misfit.jacobian.topRows(rows) = residual_changes(modelled.reading, modelled.jacobian);
    if (all_rows == rows) return misfit;
    const Misfit priors = prior_misfit(values);
    misfit.residual.tail(all_rows - rows) = priors.residual;
    misfit.jacobian.bottomRows(all_rows - rows) = priors.jacobian;
    misfit.log_volume = priors.log_volume;
    misfit.log_volume_slope = priors.log_volume_slope;
    return misfit;
}

Misfit Objective::prior_misfit(std::span<const double> values) const {
    const auto rows = static_cast<Index>(residual_count() - reading_count());
    const auto columns = static_cast<Index>(free_count());
    Misfit misfit{.residual = VectorXd(rows),
                  .jacobian = MatrixXd::Zero(rows, columns),
                  .log_volume_slope = VectorXd::Zero(columns)};
    Index row = 0;
    for (std::size_t i = 0; i < free_count(); ++i) {
        const FreeParameter& free = problem_->free[i];
        if (!free.prior) continue;
        const Residual residual = prior_residual(*free.prior, values[i]);
        misfit.residual[row] = residual.value;
        misfit.jacobian(row, static_cast<Index>(i)) = residual.slope;
        ++row;
    }
    for (const DerivedPrior& derived : problem_->derived_priors) {
        const ParameterValues all = models_[derived.measurement].at(values).values;
        const double quantity = derived_value(derived.quantity, all);
        const Residual residual = prior_residual(derived.prior, quantity);
        const Residual volume = log_score_slope(derived.prior, quantity);
        misfit.residual[row] = residual.value;
        misfit.log_volume += volume.value;
        for (std::size_t i = 0; i < free_count(); ++i) {
            if (!problem_->free[i].belongs_to(derived.measurement)) continue;
            const double slope = derived_slope(derived.quantity, all, problem_->free[i].parameter);
            // Where the residual is infinite, a parameter without effect still has none.
            if (slope == 0.0) continue;
            misfit.jacobian(row, static_cast<Index>(i)) = residual.slope * slope;
            misfit.log_volume_slope[static_cast<Index>(i)] += volume.slope * slope;
        }
        ++row;
    }
    return misfit;
}

VectorXd Objective::differences(const VectorXd& reading) const {
    VectorXd difference = reading;
    for (std::size_t k = 0; k < models_.size(); ++k) {
        const std::vector<double>& measured = problem_->measurements[k].measured;
        const auto rows = static_cast<Index>(measured.size());
        difference.segment(first_row_[k], rows) -= Eigen::Map<const VectorXd>(measured.data(), rows);
    }
    return difference;
}

MatrixXd Objective::weighted_and_whitened(const MatrixXd& changes) const {
    MatrixXd white(changes.rows(), changes.cols());
    for (std::size_t k = 0; k < noise_.size(); ++k) {
        const std::vector<double>& weights = problem_->measurements[k].weight;
        const Index first = first_row_[k];
        const Index rows = first_row_[k + 1] - first;
        if (weights.empty()) {
            white.middleRows(first, rows) = noise_[k].whiten(changes.middleRows(first, rows));
        } else {
            const Eigen::Map<const VectorXd> weight(weights.data(), rows);
            white.middleRows(first, rows) =
                noise_[k].whiten(weight.cwiseSqrt().asDiagonal() * changes.middleRows(first, rows));
        }
    }
    return white;
}

VectorXd Objective::residuals(const VectorXd& reading) const {
    VectorXd white = differences(reading);
    for (std::size_t k = 0; k < noise_.size(); ++k) {
        auto part = white.segment(first_row_[k], first_row_[k + 1] - first_row_[k]);
        part = noise_[k].whiten(part).col(0).eval();
    }
    return white;
}

VectorXd Objective::unexplained(const VectorXd& reading) const {
    VectorXd left = differences(reading);
    for (std::size_t k = 0; k < noise_.size(); ++k) {
        auto part = left.segment(first_row_[k], first_row_[k + 1] - first_row_[k]);
        part = noise_[k].unexplained(part).eval();
    }
    return left;
}

MatrixXd Objective::residual_changes(const VectorXd& reading, const MatrixXd& changes) const {
    MatrixXd whitened = weighted_and_whitened(changes);
    if (problem_->loss == Loss::squares) return whitened;
    const VectorXd hard = weighted_and_whitened(differences(reading));
    for (Index row = 0; row < whitened.rows(); ++row) {
        whitened.row(row) *= softened(hard[row], problem_->loss, problem_->loss_scale).slope;
    }
    return whitened;
}

bool Objective::minimises_chi2() const {
    const bool weighted =
        std::ranges::any_of(problem_->measurements, [](const Measurement& each) { return !each.weight.empty(); });
    return !weighted && problem_->loss == Loss::squares && residual_count() == reading_count();
}

double Objective::chi2(std::span<const double> values) const {
    return residuals(readings(values)).squaredNorm();
}

double Objective::cost(std::span<const double> values) const {
    double sum = 0.0;
    const VectorXd hard = weighted_and_whitened(differences(readings(values)));
    for (const double residual : hard) {
        const double soft = softened(residual, problem_->loss, problem_->loss_scale).value;
        sum += soft * soft;
    }
    return residual_count() == reading_count() ? sum : sum + prior_misfit(values).cost();
}

MatrixXd Objective::batch_readings(std::span<const double> values) const {
    std::vector<MatrixXd> parts;
    for (const MeasurementModel& model : models_) parts.push_back(model.batch_readings(values));
    MatrixXd all(first_row_.back(), parts.front().cols());
    for (std::size_t k = 0; k < parts.size(); ++k) all.middleRows(first_row_[k], parts[k].rows()) = parts[k];
    return all;
}

}  // namespace skinfit
