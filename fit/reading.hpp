#pragma once

#include <Eigen/Core>
#include <cassert>
#include <span>

#include "core/geometry.hpp"
#include "fit/forward_model.hpp"
#include "model/parameters.hpp"
#include "model/spectrophotometer.hpp"

/// What the instrument makes of the light.
namespace skinfit {

/// The side through which the light of `quantity` leaves.
[[nodiscard]] Side measured_side(Quantity quantity);

/// What the instrument makes of the light of one wavelength, as shares of the incident light.
struct ReadingLaw {
    double scale;
    double offset;
    double surface_weight;   ///< of the surface reflectance in the light
    bool collects_fraction;  ///< whether `specular_fraction` is that weight

    /// The light that is collected, where `share` has left the skin and the surface reflects `surface`.
    [[nodiscard]] double light(double share, double surface) const { return share + surface_weight * surface; }
    [[nodiscard]] double reading(double light) const { return scale * light + offset; }
    /// The derivative of the reading by a parameter that belongs to the instrument, all but the wavelength shift.
    [[nodiscard]] double derivative(Parameter parameter, double light, double surface) const {
        if (parameter == Parameter::scale) return light;
        if (parameter == Parameter::offset) return 1.0;
        assert(parameter == Parameter::specular_fraction);
        return (collects_fraction ? scale : 0.0) * surface;
    }
};
[[nodiscard]] ReadingLaw reading_law(const Experiment& experiment, Quantity quantity);

/// The reading at each wavelength, a fraction: scale * light + offset.
[[nodiscard]] Eigen::VectorXd readings(const EscapedLight& light, const Experiment& experiment, Quantity quantity);

/// The derivatives of `readings` by `parameters`, each per unit of the parameter: wavelengths x parameters. `light`
/// must have been computed with derivatives by the same parameters.
[[nodiscard]] Eigen::MatrixXd reading_derivatives(const EscapedLight& light, const Experiment& experiment,
                                                  Quantity quantity, std::span<const Parameter> parameters);

}  // namespace skinfit
