#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "fit/plot.hpp"
#include "fit/resolution.hpp"
#include "fit/settings.hpp"

namespace skinfit {

/// How a reading answers to each parameter, across wavelength, without noise.
struct Sensitivity {
    ResolvedConfiguration configuration;
    std::vector<double> wavelength_nm;      ///< as the instrument states it
    std::vector<double> reading;            ///< fractions
    std::vector<Parameter> parameters;      ///< those with an effect at any of the wavelengths
    std::vector<Parameter> without_effect;  ///< the others
    Eigen::MatrixXd derivative;             ///< of the reading per unit of the parameter: wavelengths x `parameters`
};

/// The reading that `configuration` describes and its derivatives by every parameter, at the wavelengths of its setting
/// and by the angular solver whatever its engine. Throws InputError for wavelengths outside the tables
/// and for a viewing cone as `check_viewing_cone` does.
[[nodiscard]] Sensitivity sensitivity(const Configuration& configuration);

/// Each derivative times the value of its parameter: the change of the reading, to first order, for a change of the
/// parameter by its own size. Wavelengths x parameters.
[[nodiscard]] Eigen::MatrixXd relative_derivative(const Sensitivity& sensitivity);

/// What the columns of an output hold.
enum class Derivative { per_unit, relative };

/// Columns wavelength_nm, reading and one per parameter with an effect, with the settings as comments on top.
[[nodiscard]] std::string sensitivity_csv(const Sensitivity& sensitivity, Derivative derivative);

/// The same as JSON, the columns of the parameters under "derivative".
[[nodiscard]] Json sensitivity_json(const Sensitivity& sensitivity, Derivative derivative);

/// The relative derivatives by the free parameters over wavelength. Throws InputError where none of them has an effect.
[[nodiscard]] Plot sensitivity_plot(const Sensitivity& sensitivity);

}  // namespace skinfit
