#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/forward_model.hpp"
#include "fit/problem.hpp"

namespace skinfit {

/// What the model says of one measurement of a problem, as a function of all the problem's free parameters.
class MeasurementModel {
public:
    /// `model` must have been made for that measurement. Refers to the problem, which must outlive it.
    MeasurementModel(const FitProblem& problem, std::size_t number, ForwardModel model);

    /// What it models, and by what.
    [[nodiscard]] const Measurement& measurement() const { return problem_->measurements[number_]; }
    [[nodiscard]] const ForwardModel& forward_model() const { return model_; }

    /// The experiment for values of the problem's free parameters.
    [[nodiscard]] Experiment at(std::span<const double> values) const;

    struct Modelled {
        Eigen::VectorXd reading;         ///< fractions
        Eigen::MatrixXd jacobian;        ///< wavelengths x free parameters; zero for those of other measurements
        Eigen::VectorXd standard_error;  ///< of `reading`: `EscapedLight::standard_error` times the scale
    };
    /// Readings, and their derivatives by the free parameters, at `values`, in the order of `FitProblem::free`.
    [[nodiscard]] Modelled model(std::span<const double> values) const;

    /// The same readings without their derivatives.
    [[nodiscard]] Eigen::VectorXd readings(std::span<const double> values) const;

    /// The reading as each batch of the ensemble alone gives it: wavelengths x batches; no columns without an ensemble.
    [[nodiscard]] Eigen::MatrixXd batch_readings(std::span<const double> values) const;

private:
    [[nodiscard]] EscapedLight light(const Experiment& experiment, std::span<const Parameter> parameters) const;

    const FitProblem* problem_;
    std::size_t number_;
    ForwardModel model_;
    std::vector<Parameter> parameters_;  // free in this measurement
    std::vector<Eigen::Index> columns_;  // theirs among all free parameters
    ModelWavelengths wavelengths_;       // of the bands, as long as no wavelength shift is free
    bool shifts_ = false;
};

}  // namespace skinfit
