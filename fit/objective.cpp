#include "fit/objective.hpp"

#include <cassert>
#include <utility>

namespace skinfit {
namespace {

using Row = Eigen::Index;

/// What the instrument collects of the light at one wavelength, before its scale and offset.
struct Collected {
    double share;
    double by_specular_fraction;
};

Collected collected(const Experiment& experiment, Quantity quantity, const Escape& escape, double surface_share) {
    if (quantity == Quantity::transmittance) return {.share = escape.share, .by_specular_fraction = 0.0};
    return {.share = escape.share + surface_weight(experiment) * surface_share,
            .by_specular_fraction = experiment.specular == Specular::excluded ? surface_share : 0.0};
}

double reading_derivative(const Experiment& experiment, const Extinction& extinction, const Escape& escape,
                          const Collected& light, Parameter parameter) {
    const Instrument& instrument = experiment.values.instrument;
    switch (parameter) {
        case Parameter::scale:
            return light.share;
        case Parameter::offset:
            return 1.0;
        case Parameter::specular_fraction:
            return instrument.scale * light.by_specular_fraction;
        default:
            break;
    }
    const PerLayer<double> depth = optical_depth_derivative(experiment.values.skin, extinction, parameter);
    double sum = 0.0;
    for (std::size_t layer = 0; layer < layer_count; ++layer) sum += escape.by_optical_depth[layer] * depth[layer];
    return instrument.scale * sum;
}

}  // namespace

Objective::Objective(const FitProblem& problem, PathEnsemble ensemble)
    : problem_(&problem),
      ensemble_(std::move(ensemble)),
      extinctions_(
          extinctions(true_wavelengths_nm(problem.experiment, problem.wavelength_nm), problem.experiment.edition)) {
    assert(ensemble_.wavelength_count() == residual_count());
}

ParameterValues Objective::with(std::span<const double> values) const {
    assert(values.size() == free_count());
    ParameterValues all = problem_->experiment.values;
    for (std::size_t i = 0; i < values.size(); ++i) value_of(all, problem_->free[i].parameter) = values[i];
    return all;
}

Side Objective::side() const {
    return problem_->quantity == Quantity::reflectance ? Side::top : Side::bottom;
}

Objective::Modelled Objective::model(std::span<const double> values) const {
    Experiment experiment = problem_->experiment;
    experiment.values = with(values);
    const Instrument& instrument = experiment.values.instrument;
    const std::vector<EnsembleResponse> responses =
        ensemble_.respond(optical_depths(experiment.values.skin, extinctions_));
    const auto rows = static_cast<Row>(residual_count());
    Modelled modelled{.reading = Eigen::VectorXd(rows),
                      .jacobian = Eigen::MatrixXd(rows, static_cast<Row>(free_count())),
                      .standard_error = Eigen::VectorXd(rows)};
    for (Row row = 0; row < rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const Escape& escape = responses[i][side()];
        const Collected light = collected(experiment, problem_->quantity, escape, ensemble_.surface_share());
        modelled.reading[row] = instrument.scale * light.share + instrument.offset;
        modelled.standard_error[row] = instrument.scale * escape.standard_error;
        for (Row column = 0; column < modelled.jacobian.cols(); ++column) {
            modelled.jacobian(row, column) = reading_derivative(
                experiment, extinctions_[i], escape, light, problem_->free[static_cast<std::size_t>(column)].parameter);
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
    Experiment experiment = problem_->experiment;
    experiment.values = with(values);
    const auto shares = ensemble_.batch_shares(optical_depths(experiment.values.skin, extinctions_), side());
    Eigen::MatrixXd readings(static_cast<Row>(shares.size()), static_cast<Row>(PathEnsemble::batch_count));
    for (Row row = 0; row < readings.rows(); ++row) {
        for (Row batch = 0; batch < readings.cols(); ++batch) {
            const Escape escape{.share = shares[static_cast<std::size_t>(row)][static_cast<std::size_t>(batch)]};
            const Collected light = collected(experiment, problem_->quantity, escape, ensemble_.surface_share());
            readings(row, batch) =
                experiment.values.instrument.scale * light.share + experiment.values.instrument.offset;
        }
    }
    return readings;
}

}  // namespace skinfit
