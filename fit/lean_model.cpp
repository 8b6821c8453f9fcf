#include "fit/lean_model.hpp"

#include <utility>

#include "core/input_error.hpp"
#include "fit/fit_scale.hpp"
#include "fit/reading.hpp"

namespace skinfit {
namespace {

/// What is minimised must be the sum of the squares of independent residuals.
void require_plain_squares(const FitProblem& problem) {
    const auto refuse = [](const std::string& where) {
        throw InputError(
            {.where = where,
             .problem = "cannot be used in a fit of many spectra",
             .why = "it minimises the sum of the squares of (modelled - measured) / sigma and nothing else",
             .remedy = "leave it out, or fit one spectrum at a time"});
    };
    if (problem.loss != Loss::squares) refuse("loss");
    if (!problem.only().weight.empty()) refuse("weights");
    if (problem.discrepancy) refuse("discrepancy");
    if (!problem.derived_priors.empty()) refuse("priors");
    for (const FreeParameter& free : problem.free) {
        if (free.prior) refuse("priors");
    }
}

}  // namespace

using Index = Eigen::Index;

LeanModel::LeanModel(const FitProblem& problem, Emulator emulator)
    : problem_(&problem),
      emulator_(std::move(emulator)),
      pigments_(model_wavelengths(problem.only().experiment, problem.only().bands.wavelength_nm).pigments) {
    require_plain_squares(problem);
}

LeanModel::Modelled LeanModel::at(std::span<const double> positions) const {
    const Measurement& measurement = problem_->only();
    Experiment experiment = measurement.experiment;
    const std::vector<double> values = from_unit_box(*problem_, positions);
    const std::vector<double> slopes = unit_box_slopes(*problem_, positions);
    for (std::size_t i = 0; i < values.size(); ++i) {
        value_of(experiment.values, problem_->free[i].parameter) = values[i];
    }
    const Skin& skin = experiment.values.skin;
    const Instrument& instrument = experiment.values.instrument;
    const std::vector<EmulatedShare> shares = emulator_.respond(optical_depths(skin, pigments_));
    const bool collects_fraction =
        measurement.quantity == Quantity::reflectance && experiment.specular == Specular::excluded;
    const double surface = collected_surface(experiment, measurement.quantity) * emulator_.surface_share();
    Modelled modelled{
        .reading = Eigen::VectorXd(static_cast<Index>(shares.size())),
        .jacobian = Eigen::MatrixXd(static_cast<Index>(shares.size()), static_cast<Index>(values.size()))};
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto row = static_cast<Index>(i);
        const double light = shares[i].share + surface;
        modelled.reading[row] = instrument.scale * light + instrument.offset;
        for (std::size_t j = 0; j < values.size(); ++j) {
            const FreeParameter& free = problem_->free[j];
            double by = 0.0;
            switch (free.parameter) {
                case Parameter::scale:
                    by = light;
                    break;
                case Parameter::offset:
                    by = 1.0;
                    break;
                case Parameter::specular_fraction:
                    by = collects_fraction ? instrument.scale * emulator_.surface_share() : 0.0;
                    break;
                default: {
                    const PerLayer<double> depth_by = optical_depth_derivative(skin, pigments_[i], free.parameter);
                    for (std::size_t layer = 0; layer < layer_count; ++layer) {
                        by += instrument.scale * shares[i].by_optical_depth[layer] * depth_by[layer];
                    }
                }
            }
            modelled.jacobian(row, static_cast<Index>(j)) = by * slopes[j];
        }
    }
    modelled.reading = measurement.bands.readings(std::move(modelled.reading));
    modelled.jacobian = measurement.bands.readings(std::move(modelled.jacobian));
    const Eigen::Map<const Eigen::VectorXd> sigma(measurement.sigma.data(), modelled.reading.size());
    modelled.reading.array() /= sigma.array();
    modelled.jacobian.array().colwise() /= sigma.array();
    return modelled;
}

}  // namespace skinfit
