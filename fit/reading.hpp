#pragma once

#include <Eigen/Core>
#include <span>

#include "core/geometry.hpp"
#include "fit/forward_model.hpp"
#include "model/parameters.hpp"
#include "model/spectrophotometer.hpp"

/// What the instrument makes of the light.
namespace skinfit {

/// The side through which the light of `quantity` leaves.
[[nodiscard]] Side measured_side(Quantity quantity);

/// The reading at each wavelength, a fraction: scale * light + offset.
[[nodiscard]] Eigen::VectorXd readings(const EscapedLight& light, const Experiment& experiment, Quantity quantity);

/// The derivatives of `readings` by `parameters`, each per unit of the parameter: wavelengths x parameters. `light`
/// must have been computed with derivatives by the same parameters.
[[nodiscard]] Eigen::MatrixXd reading_derivatives(const EscapedLight& light, const Experiment& experiment,
                                                  Quantity quantity, std::span<const Parameter> parameters);

}  // namespace skinfit
