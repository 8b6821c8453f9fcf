#include "fit/measurement_model.hpp"

#include <cassert>
#include <utility>

#include "fit/reading.hpp"

namespace skinfit {

using Index = Eigen::Index;

MeasurementModel::MeasurementModel(const FitProblem& problem, std::size_t number, ForwardModel model)
    : problem_(&problem),
      number_(number),
      model_(std::move(model)),
      wavelengths_(model_wavelengths(measurement().experiment, measurement().bands.wavelength_nm)) {
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const FreeParameter& free = problem.free[i];
        if (!free.belongs_to(number)) continue;
        parameters_.push_back(free.parameter);
        columns_.push_back(static_cast<Index>(i));
        shifts_ = shifts_ || free.parameter == Parameter::wavelength_shift_nm;
    }
}

Experiment MeasurementModel::at(std::span<const double> values) const {
    assert(values.size() == problem_->free.size());
    Experiment experiment = measurement().experiment;
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
        value_of(experiment.values, parameters_[k]) = values[static_cast<std::size_t>(columns_[k])];
    }
    return experiment;
}

EscapedLight MeasurementModel::light(const Experiment& experiment, std::span<const Parameter> parameters) const {
    const Side side = measured_side(measurement().quantity);
    if (!shifts_) return light_of(model_, experiment, side, wavelengths_, parameters);
    return light_of(model_, experiment, side, model_wavelengths(experiment, measurement().bands.wavelength_nm),
                    parameters);
}

MeasurementModel::Modelled MeasurementModel::model(std::span<const double> values) const {
    const Experiment experiment = at(values);
    const Quantity quantity = measurement().quantity;
    const EscapedLight escaped = light(experiment, parameters_);
    // Neighbouring wavelengths share their random numbers, so their errors add up as their readings do.
    const BandSampling& bands = measurement().bands;
    Modelled modelled{
        .reading = bands.readings(skinfit::readings(escaped, experiment, quantity)),
        .jacobian = bands.readings(reading_derivatives(escaped, experiment, quantity, parameters_)),
        .standard_error = bands.readings(Eigen::VectorXd(experiment.values.instrument.scale * escaped.standard_error))};
    if (columns_.size() == values.size()) return modelled;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(modelled.jacobian.rows(), static_cast<Index>(values.size()));
    all(Eigen::all, columns_) = modelled.jacobian;
    modelled.jacobian = std::move(all);
    return modelled;
}

Eigen::VectorXd MeasurementModel::readings(std::span<const double> values) const {
    const Experiment experiment = at(values);
    return measurement().bands.readings(skinfit::readings(light(experiment, {}), experiment, measurement().quantity));
}

Eigen::MatrixXd MeasurementModel::batch_readings(std::span<const double> values) const {
    const Quantity quantity = measurement().quantity;
    const auto* const ensemble = std::get_if<PathEnsemble>(&model_);
    if (ensemble == nullptr) return Eigen::MatrixXd(static_cast<Index>(measurement().wavelength_nm.size()), 0);
    const Experiment experiment = at(values);
    const ReadingLaw law = reading_law(experiment, quantity);
    const auto shares =
        ensemble->batch_shares(optical_depths(experiment.values.skin, wavelengths_.pigments), measured_side(quantity));
    Eigen::MatrixXd readings(static_cast<Index>(shares.size()), static_cast<Index>(PathEnsemble::batch_count));
    for (Index row = 0; row < readings.rows(); ++row) {
        for (Index batch = 0; batch < readings.cols(); ++batch) {
            const double share = shares[static_cast<std::size_t>(row)][static_cast<std::size_t>(batch)];
            readings(row, batch) = law.reading(law.light(share, ensemble->surface_share()));
        }
    }
    return measurement().bands.readings(std::move(readings));
}

}  // namespace skinfit
