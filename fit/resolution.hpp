#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/configuration.hpp"
#include "measurements/spectrum.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// A configuration in which everything is decided: by the user, else by the instrument, else by the measured file, else
/// by the defaults. Whatever comes after `resolved` takes this, and reads no file again.
struct ResolvedConfiguration : FitSettings {
    Edition edition = default_edition;
    int layers = default_layers;
    Base base;
    double incidence_deg = default_incidence_deg;
    Specular specular = default_specular;
    bool specular_is_assumed = false;        ///< nothing states it
    std::optional<double> viewing_cone_deg;  ///< half angle about the normal; none: the hemisphere is collected
    std::string instrument;                  ///< its name or file, for the record; empty: none
    Bandpass bandpass;                       ///< of width 0: single wavelengths
    Quantity quantity = default_quantity;
    double noise = default_noise;  ///< standard uncertainty of a value where the file states none, fraction
};

/// `configuration` with what it leaves unset of geometry, bandpass and noise as its instrument has it.
[[nodiscard]] Configuration with_instrument(Configuration configuration);

/// `configuration` for `spectrum`; without one, for a simulation. Throws InputError for a hypodermis below two layers.
[[nodiscard]] ResolvedConfiguration resolved(Configuration configuration, const Spectrum& spectrum = {});

/// A configuration that states all that is decided; `instrument` is named, what it says is stated beside it.
[[nodiscard]] Configuration as_stated(const ResolvedConfiguration& resolved);

/// The experiment that a configuration describes.
[[nodiscard]] Experiment make_experiment(const ResolvedConfiguration& resolved);

/// The same of a simulation, resolved first. Throws InputError as `resolved`.
[[nodiscard]] Experiment make_experiment(const Configuration& configuration);

/// The bandpass; none where it has no width.
[[nodiscard]] std::optional<Bandpass> bandpass_of(const ResolvedConfiguration& resolved);

/// Spectra that one fit explains together, each with all that is decided of it.
struct FitInput {
    Configuration stated;  ///< with the edition, layers and base that the files state
    struct Part {
        ResolvedConfiguration configuration;
        Spectrum spectrum;  ///< as its file holds it
    };
    std::vector<Part> parts;  ///< at least one
};

/// What a fit of `spectra` (at least one) takes. Throws InputError as `with_file_settings` and `resolved`.
[[nodiscard]] FitInput fit_input(const Configuration& configuration, std::span<const Spectrum> spectra);

}  // namespace skinfit
