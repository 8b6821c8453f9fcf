#pragma once

#include <span>
#include <string>
#include <vector>

#include "fit/band_sampling.hpp"
#include "fit/resolution.hpp"
#include "measurements/spectrum.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// One measured spectrum, and the experiment that is to explain it.
struct Measurement {
    std::string name;       ///< of the specimen
    std::string source;     ///< the file it came from
    std::string unit_rule;  ///< how the unit of its values was found, in words
    ResolvedConfiguration configuration;
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

/// `spectrum` as the fit takes it: what lies in the window, which alone is looked at. Throws InputError for no
/// wavelengths in the window, for wavelengths or bands outside the tables, for a wavelength that comes twice, for
/// uncertainties that are missing or not above 0, for a constant spectrum, and for a viewing cone that the engine or
/// geometry cannot have.
[[nodiscard]] Measurement make_measurement(const ResolvedConfiguration& configuration, const Spectrum& spectrum);

/// Throws InputError where two of the measurements hold the same values, which would count twice, or where a
/// reflectance and a transmittance of one specimen add up to more than 1 by more than their noise explains.
void check_consistency(std::span<const Measurement> measurements);

}  // namespace skinfit
