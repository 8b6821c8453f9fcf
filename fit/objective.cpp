#include "fit/objective.hpp"

#include <cassert>
#include <utility>

#include "fit/reading.hpp"

namespace skinfit {

using Row = Eigen::Index;

Objective::Objective(const FitProblem& problem, ForwardModel model) : problem_(&problem), model_(std::move(model)) {
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
    const std::vector<Light> lights =
        light_of(model_, experiment, measured_side(quantity), problem_->wavelength_nm, parameters_);
    const auto rows = static_cast<Row>(residual_count());
    Modelled modelled{.reading = Eigen::VectorXd(rows),
                      .jacobian = Eigen::MatrixXd(rows, static_cast<Row>(free_count())),
                      .standard_error = Eigen::VectorXd(rows)};
    for (Row row = 0; row < rows; ++row) {
        const Light& light = lights[static_cast<std::size_t>(row)];
        modelled.reading[row] = reading(light, experiment, quantity);
        modelled.standard_error[row] = experiment.values.instrument.scale * light.standard_error;
        modelled.jacobian.row(row) = reading_derivatives(light, experiment, quantity, parameters_);
    }
    return modelled;
}

Misfit Objective::misfit(std::span<const double> values) const {
    const Modelled modelled = model(values);
    const Eigen::Map<const Eigen::VectorXd> sigma(problem_->sigma.data(), modelled.reading.size());
    return {.residual = residuals(modelled.reading), .jacobian = sigma.cwiseInverse().asDiagonal() * modelled.jacobian};
}

Eigen::VectorXd Objective::residuals(const Eigen::VectorXd& reading) const {
    Eigen::VectorXd residuals(reading.size());
    for (Row row = 0; row < reading.size(); ++row) {
        const auto i = static_cast<std::size_t>(row);
        residuals[row] = (reading[row] - problem_->measured[i]) / problem_->sigma[i];
    }
    return residuals;
}

double Objective::chi2(std::span<const double> values) const {
    return residuals(model(values).reading).squaredNorm();
}

Eigen::MatrixXd Objective::batch_readings(std::span<const double> values) const {
    constexpr auto batches = static_cast<Row>(PathEnsemble::batch_count);
    const auto* const ensemble = std::get_if<PathEnsemble>(&model_);
    if (ensemble == nullptr) return Eigen::MatrixXd(static_cast<Row>(residual_count()), 0);
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
