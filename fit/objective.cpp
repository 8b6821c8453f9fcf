#include "fit/objective.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "fit/loss.hpp"
#include "fit/reading.hpp"

namespace skinfit {

using Row = Eigen::Index;

Objective::Objective(const FitProblem& problem, ForwardModel model)
    : problem_(&problem), noise_(problem.wavelength_nm, problem.sigma, problem.discrepancy), model_(std::move(model)) {
    for (const FreeParameter& free : problem.free) parameters_.push_back(free.parameter);
}

Experiment Objective::with(std::span<const double> values) const {
    assert(values.size() == free_count());
    Experiment experiment = problem_->experiment;
    for (std::size_t i = 0; i < values.size(); ++i) value_of(experiment.values, parameters_[i]) = values[i];
    return experiment;
}

Objective::Modelled Objective::model(std::span<const double> values) const {
    const Experiment experiment = with(values);
    const Quantity quantity = problem_->quantity;
    const std::vector<EscapedLight> lights =
        light_of(model_, experiment, measured_side(quantity), problem_->wavelength_nm, parameters_);
    const auto rows = static_cast<Row>(wavelength_count());
    Modelled modelled{.reading = Eigen::VectorXd(rows),
                      .jacobian = Eigen::MatrixXd(rows, static_cast<Row>(free_count())),
                      .standard_error = Eigen::VectorXd(rows)};
    for (Row row = 0; row < rows; ++row) {
        const EscapedLight& light = lights[static_cast<std::size_t>(row)];
        modelled.reading[row] = reading(light, experiment, quantity);
        modelled.standard_error[row] = experiment.values.instrument.scale * light.standard_error;
        modelled.jacobian.row(row) = reading_derivatives(light, experiment, quantity, parameters_);
    }
    return modelled;
}

Eigen::VectorXd Objective::readings_of(const Experiment& experiment) const {
    const Quantity quantity = problem_->quantity;
    const std::vector<EscapedLight> lights =
        light_of(model_, experiment, measured_side(quantity), problem_->wavelength_nm, {});
    Eigen::VectorXd readings(static_cast<Row>(lights.size()));
    for (Row row = 0; row < readings.size(); ++row) {
        readings[row] = reading(lights[static_cast<std::size_t>(row)], experiment, quantity);
    }
    return readings;
}

Eigen::VectorXd Objective::readings(std::span<const double> values) const {
    return readings_of(with(values));
}

std::size_t Objective::residual_count() const {
    const auto on_parameters =
        std::ranges::count_if(problem_->free, [](const FreeParameter& free) { return free.prior.has_value(); });
    return wavelength_count() + static_cast<std::size_t>(on_parameters) + problem_->derived_priors.size();
}

Misfit Objective::misfit(std::span<const double> values) const {
    const Modelled modelled = model(values);
    const auto rows = static_cast<Row>(wavelength_count());
    const Eigen::VectorXd hard = weighted_and_whitened(differences(modelled.reading));
    Misfit misfit{.residual = Eigen::VectorXd(static_cast<Row>(residual_count())),
                  .jacobian = Eigen::MatrixXd::Zero(static_cast<Row>(residual_count()), modelled.jacobian.cols())};
    for (Row row = 0; row < rows; ++row) {
        misfit.residual[row] = softened(hard[row], problem_->loss, problem_->loss_scale).value;
    }
    misfit.jacobian.topRows(rows) = residual_changes(modelled.reading, modelled.jacobian);
    add_priors(with(values), misfit);
    return misfit;
}

void Objective::add_priors(const Experiment& experiment, Misfit& misfit) const {
    auto row = static_cast<Row>(wavelength_count());
    for (std::size_t i = 0; i < problem_->free.size(); ++i) {
        const FreeParameter& free = problem_->free[i];
        if (!free.prior) continue;
        const Residual residual = prior_residual(*free.prior, value_of(experiment.values, free.parameter));
        misfit.residual[row] = residual.value;
        misfit.jacobian(row, static_cast<Row>(i)) = residual.slope;
        ++row;
    }
    for (const DerivedPrior& derived : problem_->derived_priors) {
        const Residual residual = prior_residual(derived.prior, derived_value(derived.quantity, experiment.values));
        misfit.residual[row] = residual.value;
        for (std::size_t i = 0; i < parameters_.size(); ++i) {
            const double slope = derived_slope(derived.quantity, experiment.values, parameters_[i]);
            // Where the residual is infinite, a parameter without effect still has none.
            misfit.jacobian(row, static_cast<Row>(i)) = slope == 0.0 ? 0.0 : residual.slope * slope;
        }
        ++row;
    }
}

Eigen::VectorXd Objective::differences(const Eigen::VectorXd& reading) const {
    return reading - Eigen::Map<const Eigen::VectorXd>(problem_->measured.data(), reading.size());
}

Eigen::MatrixXd Objective::weighted_and_whitened(const Eigen::MatrixXd& changes) const {
    if (problem_->weight.empty()) return noise_.whiten(changes);
    const Eigen::Map<const Eigen::VectorXd> weight(problem_->weight.data(), changes.rows());
    return noise_.whiten(weight.cwiseSqrt().asDiagonal() * changes);
}

Eigen::VectorXd Objective::residuals(const Eigen::VectorXd& reading) const {
    return noise_.whiten(differences(reading));
}

Eigen::VectorXd Objective::unexplained(const Eigen::VectorXd& reading) const {
    return noise_.unexplained(differences(reading));
}

Eigen::MatrixXd Objective::residual_changes(const Eigen::VectorXd& reading, const Eigen::MatrixXd& changes) const {
    Eigen::MatrixXd whitened = weighted_and_whitened(changes);
    if (problem_->loss == Loss::squares) return whitened;
    const Eigen::VectorXd hard = weighted_and_whitened(differences(reading));
    for (Row row = 0; row < whitened.rows(); ++row) {
        whitened.row(row) *= softened(hard[row], problem_->loss, problem_->loss_scale).slope;
    }
    return whitened;
}

double Objective::chi2(std::span<const double> values) const {
    return residuals(readings(values)).squaredNorm();
}

double Objective::cost(std::span<const double> values) const {
    const Experiment experiment = with(values);
    double sum = 0.0;
    const auto add = [&sum](double residual) { sum += residual * residual; };
    const Eigen::VectorXd hard = weighted_and_whitened(differences(readings_of(experiment)));
    for (const double residual : hard) add(softened(residual, problem_->loss, problem_->loss_scale).value);
    for (const FreeParameter& free : problem_->free) {
        if (free.prior) add(prior_residual(*free.prior, value_of(experiment.values, free.parameter)).value);
    }
    for (const DerivedPrior& derived : problem_->derived_priors) {
        add(prior_residual(derived.prior, derived_value(derived.quantity, experiment.values)).value);
    }
    return sum;
}

Eigen::MatrixXd Objective::batch_readings(std::span<const double> values) const {
    constexpr auto batches = static_cast<Row>(PathEnsemble::batch_count);
    const auto* const ensemble = std::get_if<PathEnsemble>(&model_);
    if (ensemble == nullptr) return Eigen::MatrixXd(static_cast<Row>(wavelength_count()), 0);
    const Experiment experiment = with(values);
    const Instrument& instrument = experiment.values.instrument;
    const double surface = collected_surface(experiment, problem_->quantity) * ensemble->surface_share();
    const std::vector<Extinction> pigments =
        extinctions(true_wavelengths_nm(experiment, problem_->wavelength_nm), experiment.edition);
    const auto shares =
        ensemble->batch_shares(optical_depths(experiment.values.skin, pigments), measured_side(problem_->quantity));
    Eigen::MatrixXd readings(static_cast<Row>(shares.size()), batches);
    for (Row row = 0; row < readings.rows(); ++row) {
        for (Row batch = 0; batch < batches; ++batch) {
            const double share = shares[static_cast<std::size_t>(row)][static_cast<std::size_t>(batch)];
            readings(row, batch) = instrument.scale * (share + surface) + instrument.offset;
        }
    }
    return readings;
}

}  // namespace skinfit
