#pragma once

#include <Eigen/Core>
#include <span>
#include <variant>
#include <vector>

#include "model/angular_solver.hpp"
#include "model/path_ensemble.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// What computes the light that leaves the sample: walks recorded for it, or the angular solver.
using ForwardModel = std::variant<PathEnsemble, AngularSolver>;

/// The light of one wavelength, as shares of the incident light, and its derivatives by some parameters.
struct Light {
    double surface;         ///< reflected by the surface
    double share;           ///< left through the side that is measured, without `surface`; a factor in a viewing cone
    double standard_error;  ///< of `share`, Monte Carlo
    Eigen::RowVectorXd surface_by;
    Eigen::RowVectorXd share_by;
};

/// The light at each of the instrument's wavelengths, derivatives by `parameters`. Instrument parameters have zeros,
/// but for the wavelength shift, by which the angular solver is differenced over 0.1 nm. A `PathEnsemble` must have
/// been traced for the experiment; it knows no derivative by parameters that steer rays.
[[nodiscard]] std::vector<Light> light_of(const ForwardModel& model, const Experiment& experiment, Side side,
                                          const std::vector<double>& wavelengths_nm,
                                          std::span<const Parameter> parameters);

}  // namespace skinfit
