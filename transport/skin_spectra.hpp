#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "transport/layered_skin.hpp"

namespace skinfit {

/// How described skins are lit and read, and with what effort.
struct SkinTransportOptions {
    std::optional<double> incidence_rad = 8.0 * std::numbers::pi / 180.0;  ///< as `PhotonOptions` has it
    /// Instruments that share this light. `Gathering{}` is a sphere; one whose spot and port are equal a small port;
    /// one with a cone and without specular light, at 45 degrees of incidence, a 45/0 instrument.
    std::vector<Gathering> gatherings = {{}};
    std::uint64_t photons = 100'000;  ///< per wavelength and trace, 2 or more
    std::uint64_t seed = 1;
    BilirubinBand bilirubin = {};
    /// Skins that differ in absorption alone share a trace. With a ratio, above 1, those that differ in `scattering`
    /// too share traces at values of mu_s' that lie at most this factor apart, and readings are cubic in ln mu_s'
    /// between four of them. None: each scattering has its own trace.
    std::optional<double> node_ratio = {};
};

/// Readings: [skin][gathering][wavelength].
using SkinReadings = std::vector<std::vector<std::vector<PhotonMean>>>;

/// The reflectance spectra of `skins`. Photons of one number are lit alike at every wavelength, so that spectra are
/// smooth; errors are independent from trace to trace. The same bits on any number of threads. Throws InputError for
/// wavelengths outside the tables, Cancelled soon after `stop` is requested.
[[nodiscard]] SkinReadings skin_spectra(std::span<const LayeredSkin> skins, const std::vector<double>& wavelengths_nm,
                                        const SkinTransportOptions& options, const std::stop_token& stop = {});

}  // namespace skinfit
