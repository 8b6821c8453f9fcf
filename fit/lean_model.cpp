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

/// What was modelled at the wavelengths of the model, in bands and in sigmas of each.
LeanModel::Modelled in_sigmas(LeanModel::Modelled modelled, const Measurement& measurement) {
    modelled.reading = measurement.bands.readings(std::move(modelled.reading));
    modelled.jacobian = measurement.bands.readings(std::move(modelled.jacobian));
    const Eigen::Map<const Eigen::VectorXd> sigma(measurement.sigma.data(), modelled.reading.size());
    modelled.reading.array() /= sigma.array();
    modelled.jacobian.array().colwise() /= sigma.array();
    return modelled;
}

}  // namespace

using Index = Eigen::Index;

LeanModel::LeanModel(const FitProblem& problem, Emulator emulator)
    : problem_(&problem),
      emulator_(std::move(emulator)),
      pigments_(model_wavelengths(problem.only().experiment, problem.only().bands.wavelength_nm).pigments) {
    require_plain_squares(problem);
    for (const FreeParameter& free : problem.free) of_instrument_.push_back(belongs_to_instrument(free.parameter));
}

Experiment LeanModel::experiment_at(std::span<const double> positions) const {
    Experiment experiment = problem_->only().experiment;
    const std::vector<double> values = from_unit_box(*problem_, positions);
    for (std::size_t i = 0; i < values.size(); ++i) {
        value_of(experiment.values, problem_->free[i].parameter) = values[i];
    }
    return experiment;
}

LeanModel::Modelled LeanModel::at(std::span<const double> positions) const {
    const Measurement& measurement = problem_->only();
    const Experiment experiment = experiment_at(positions);
    const std::vector<double> slopes = unit_box_slopes(*problem_, positions);
    const Skin& skin = experiment.values.skin;
    const ReadingLaw law = reading_law(experiment, measurement.quantity);
    const double surface = emulator_.surface_share();
    const std::vector<EmulatedShare> shares = emulator_.respond(optical_depths(skin, pigments_));
    Modelled modelled{
        .reading = Eigen::VectorXd(static_cast<Index>(shares.size())),
        .jacobian = Eigen::MatrixXd(static_cast<Index>(shares.size()), static_cast<Index>(slopes.size()))};
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto row = static_cast<Index>(i);
        const double light = law.light(shares[i].share, surface);
        modelled.reading[row] = law.reading(light);
        for (std::size_t j = 0; j < slopes.size(); ++j) {
            const Parameter parameter = problem_->free[j].parameter;
            const double by = of_instrument_[j] ? law.derivative(parameter, light, surface)
                                                : law.scale * pigment_derivative(shares[i].by_optical_depth, skin,
                                                                                 pigments_[i], parameter);
            modelled.jacobian(row, static_cast<Index>(j)) = by * slopes[j];
        }
    }
    return in_sigmas(std::move(modelled), measurement);
}

}  // namespace skinfit
