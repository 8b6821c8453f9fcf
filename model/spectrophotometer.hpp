#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry.hpp"
#include "model/angular_solver.hpp"
#include "model/chromophores.hpp"
#include "model/emulator.hpp"
#include "model/parameters.hpp"
#include "model/path_ensemble.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// A specimen in a spectrophotometer.
struct Experiment {
    ParameterValues values;
    Edition edition = Edition::revised;
    int layers = 4;
    Base base;
    double incidence_rad = 0.0;
    Specular specular = Specular::included;
    /// Half angle of the cone about the normal through which the instrument looks, up to pi/2; unset: it collects the
    /// whole hemisphere. With a cone the reflectance is the reflectance factor: the radiance averaged over the cone
    /// relative to that of a perfect white diffuser, without the surface reflection, which a 45/0 instrument avoids.
    std::optional<double> viewing_cone_rad = {};

    /// The skin with its surroundings.
    [[nodiscard]] Sample sample() const {
        return {.skin = values.skin, .edition = edition, .layers = layers, .base = base};
    }
};

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

/// The law of the experiment's instrument. With a viewing cone the surface has no part in the light.
[[nodiscard]] ReadingLaw reading_law(const Experiment& experiment, Quantity quantity);

/// The wavelengths at which the model is evaluated for an instrument that states `wavelengths_nm`.
[[nodiscard]] std::vector<double> true_wavelengths_nm(const Experiment& experiment,
                                                      const std::vector<double>& wavelengths_nm);

/// What the instrument reads at one wavelength, as fractions.
struct Reading {
    double wavelength_nm;  ///< as the instrument states it
    double reflectance;    ///< scale * (subsurface reflectance or its factor + collected surface reflectance) + offset
    /// Standard error of random numbers; by the solver the error it states, by the emulator that it is certified for.
    double reflectance_se;
    double transmittance;        ///< scale * transmitted share + offset, whatever the viewing cone
    double transmittance_se;     ///< as `reflectance_se`
    double surface_reflectance;  ///< of the surface alone, whether collected or not
};

/// The readings by the analog walk: every ray survives or is absorbed.
[[nodiscard]] std::vector<Reading> read_by_walk(const Experiment& experiment, const std::vector<double>& wavelengths_nm,
                                                std::uint64_t rays, std::uint64_t seed);

/// The readings by an ensemble traced for this experiment, which has no viewing cone, at `true_wavelengths_nm`.
[[nodiscard]] std::vector<Reading> read_by_paths(const Experiment& experiment,
                                                 const std::vector<double>& wavelengths_nm,
                                                 const PathEnsemble& ensemble);

/// The angular solver of the experiment's sample, incidence and viewing cone.
[[nodiscard]] AngularSolver angular_solver(
    const Experiment& experiment,
    const AngularResolution& resolution = AngularResolution::for_accuracy(solver_accuracy));

/// The readings by the angular solver: without noise; in place of standard errors they have the solver's stated errors.
[[nodiscard]] std::vector<Reading> read_by_solver(const Experiment& experiment,
                                                  const std::vector<double>& wavelengths_nm);

/// The readings by emulators of this experiment at `true_wavelengths_nm`, one for each side through which light leaves;
/// their standard errors are the errors for which the emulators are certified. Throws InputError outside their domains.
[[nodiscard]] std::vector<Reading> read_by_emulator(const Experiment& experiment,
                                                    const std::vector<double>& wavelengths_nm, const Emulator& top,
                                                    const std::optional<Emulator>& bottom);

/// The layers' optical depths at each wavelength at which the model is evaluated.
[[nodiscard]] std::vector<PerLayer<double>> optical_depths(const Skin& skin,
                                                           const std::vector<Extinction>& extinctions);

/// The pigments' extinctions at each wavelength. Throws InputError outside the tables.
[[nodiscard]] std::vector<Extinction> extinctions(const std::vector<double>& wavelengths_nm, Edition edition);

}  // namespace skinfit
