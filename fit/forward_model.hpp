#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "model/angular_solver.hpp"
#include "model/emulator.hpp"
#include "model/path_ensemble.hpp"
#include "model/radius_emulator.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// What computes the light that leaves the sample: walks recorded for it, the angular solver, or its emulator, of one
/// radius of the fibrils or of a range.
using ForwardModel = std::variant<PathEnsemble, AngularSolver, Emulator, RadiusEmulator>;

/// The largest error for which an emulator is certified; nothing for another model.
[[nodiscard]] std::optional<double> certified_error(const ForwardModel& model);

/// The light at some wavelengths, as shares of the incident light, and its derivatives by some parameters: rows are
/// wavelengths, columns parameters.
struct EscapedLight {
    Eigen::VectorXd surface;         ///< reflected by the surface
    Eigen::VectorXd share;           ///< left through the side that is measured, without `surface`; a factor in a cone
    Eigen::VectorXd standard_error;  ///< of `share`: Monte Carlo, or the error for which the emulator is certified
    Eigen::MatrixXd surface_by;
    Eigen::MatrixXd share_by;
};

/// The wavelengths at which the model is evaluated, and what absorbs there.
struct ModelWavelengths {
    std::vector<double> true_nm;       ///< `true_wavelengths_nm`
    std::vector<Extinction> pigments;  ///< one per wavelength
};
[[nodiscard]] ModelWavelengths model_wavelengths(const Experiment& experiment,
                                                 const std::vector<double>& wavelengths_nm);

/// The light at each of the wavelengths, derivatives by `parameters`. Instrument parameters have zeros, but for the
/// wavelength shift, by which the angular solver is differenced over 0.1 nm. A `PathEnsemble` must have been traced for
/// the experiment; it knows no derivative by parameters that steer rays, and of a
/// dermal thickness the part by absorption alone. The same holds for an `Emulator`, which must
/// have been built for the side that is measured too; outside its domain InputError is thrown. A `RadiusEmulator` knows
/// the derivative by the fibril radius beside those.
[[nodiscard]] EscapedLight light_of(const ForwardModel& model, const Experiment& experiment, Side side,
                                    const ModelWavelengths& wavelengths, std::span<const Parameter> parameters);

}  // namespace skinfit
