#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/band_sampling.hpp"
#include "fit/configuration.hpp"
#include "measurements/spectrum.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// One measured spectrum, and the experiment that is to explain it.
struct Measurement {
    std::string source;     ///< the file it came from
    Experiment experiment;  ///< fixed values, and the starts of the free ones
    Quantity quantity = Quantity::reflectance;
    std::vector<double> wavelength_nm;  ///< within the window of the fit
    std::vector<double> measured;       ///< fractions
    std::vector<double> sigma;          ///< standard uncertainty of `measured`
    std::string sigma_source;           ///< in words
    WalkOptions walk;
    std::vector<double> weight{};  ///< of each squared residual; empty: 1
    BandSampling bands{};          ///< of the wavelengths
};

/// The experiment that `configuration` describes; its instrument and the defaults fill in what it leaves open. Throws
/// InputError for an instrument that is unknown or malformed, and for a hypodermis below two layers.
[[nodiscard]] Experiment make_experiment(const Configuration& configuration);

/// `configuration` with everything filled in that the spectrum or the defaults decide. Throws as `make_experiment`.
[[nodiscard]] Configuration resolved(Configuration configuration, const Spectrum& spectrum);

/// The bandpass of a resolved configuration; none where it has no width.
[[nodiscard]] std::optional<Bandpass> bandpass_of(const Configuration& resolved_configuration);

/// `spectrum` as the fit takes it. Throws InputError for no wavelengths in the window, for wavelengths or bands outside
/// the tables, for a constant spectrum, for a viewing cone that the engine or geometry cannot have, and as
/// `make_experiment`.
[[nodiscard]] Measurement make_measurement(const Configuration& resolved_configuration, const Spectrum& spectrum);

/// Throws InputError where two of the measurements hold the same values, which would count twice, or where a
/// reflectance and a transmittance of one specimen add up to more than 1 by more than their noise explains.
void check_consistency(std::span<const Measurement> measurements);

}  // namespace skinfit
