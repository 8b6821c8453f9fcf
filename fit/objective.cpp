#include "fit/objective.hpp"

#include <cassert>
#include <utility>

namespace skinfit {
namespace {

using Row = Eigen::Index;

/// The share of the surface reflectance in the reading.
double collected_surface(const Experiment& experiment, Quantity quantity) {
    return quantity == Quantity::reflectance ? surface_weight(experiment) : 0.0;
}

/// The derivative of the reading by the free parameter of one column.
double reading_derivative(const FitProblem& problem, const Experiment& experiment, const Light& light, Row column) {
    const double surface = collected_surface(experiment, problem.quantity);
    const double scale = experiment.values.instrument.scale;
    const bool collects_fraction =
        problem.quantity == Quantity::reflectance && experiment.specular == Specular::excluded;
    switch (problem.free[static_cast<std::size_t>(column)].parameter) {
        case Parameter::scale:
            return light.share + surface * light.surface;
        case Parameter::offset:
            return 1.0;
        case Parameter::specular_fraction:
            return collects_fraction ? scale * light.surface : 0.0;
        default:
            return scale * (light.share_by[column] + surface * light.surface_by[column]);
    }
}

}  // namespace

Objective::Objective(const FitProblem& problem, ForwardModel model) : problem_(&problem), model_(std::move(model)) {
    for (const FreeParameter& free : problem.free) parameters_.push_back(free.parameter);
}

Experiment Objective::with(std::span<const double> values) const {
    assert(values.size() == free_count());
    Experiment experiment = problem_->experiment;
    for (std::size_t i = 0; i < values.size(); ++i) value_of(experiment.values, parameters_[i]) = values[i];
    return experiment;
}

Side Objective::side() const {
    return problem_->quantity == Quantity::reflectance ? Side::top : Side::bottom;
}

Objective::Modelled Objective::model(std::span<const double> values) const {
    const Experiment experiment = with(values);
    const Instrument& instrument = experiment.values.instrument;
    const double surface = collected_surface(experiment, problem_->quantity);
    const std::vector<Light> lights = light_of(model_, experiment, side(), problem_->wavelength_nm, parameters_);
    const auto rows = static_cast<Row>(residual_count());
    Modelled modelled{.reading = Eigen::VectorXd(rows),
                      .jacobian = Eigen::MatrixXd(rows, static_cast<Row>(free_count())),
                      .standard_error = Eigen::VectorXd(rows)};
    for (Row row = 0; row < rows; ++row) {
        const Light& light = lights[static_cast<std::size_t>(row)];
        modelled.reading[row] = instrument.scale * (light.share + surface * light.surface) + instrument.offset;
        modelled.standard_error[row] = instrument.scale * light.standard_error;
        for (Row column = 0; column < modelled.jacobian.cols(); ++column) {
            modelled.jacobian(row, column) = reading_derivative(*problem_, experiment, light, column);
        }
    }
    return modelled;
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
    const auto shares = ensemble->batch_shares(optical_depths(experiment.values.skin, pigments), side());
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
