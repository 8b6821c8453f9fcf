#pragma once

#include <functional>
#include <span>
#include <vector>

#include "model/emulator.hpp"

namespace skinfit {

/// The share of the light that leaves, and how it answers to absorption and to the radius of the fibrils.
struct RadiusShare {
    double share = 0.0;
    PerLayer<double> by_optical_depth{};
    double by_fibril_radius_nm = 0.0;
};

/// Emulators of one geometry at some radii of the collagen fibrils, the only thing of all that steers which they let
/// vary. Between them the share is the polynomial in log(radius) through the Chebyshev points of the range.
/// docs/model.md, section "Emulator", has accuracy and cost. Copies share the series; calls may come from any thread.
class RadiusEmulator {
public:
    using Make = std::function<Emulator(const EmulatorDomain&)>;

    /// For the domain, one of whose ranges is that of the fibril radius. `make` gives the emulators of single radii,
    /// built or kept. Throws what `make` throws.
    RadiusEmulator(const EmulatorDomain& domain, const Make& make);

    /// The share of the light that the surface reflects, whatever the radius.
    [[nodiscard]] double surface_share() const { return emulators_.front().surface_share(); }
    [[nodiscard]] std::size_t wavelength_count() const { return emulators_.front().wavelength_count(); }

    /// The largest certified error of its emulators, and the last term of the polynomial, where it is largest
    /// among 256 specimens of the domain: a share of the incident light; an observation, no proven bound.
    [[nodiscard]] double certified_error(std::size_t wavelength) const { return certified_error_[wavelength]; }
    /// The largest over all wavelengths.
    [[nodiscard]] double certified_error() const;

    /// The share at each wavelength for the layers' optical depths there. Throws InputError outside the domain.
    [[nodiscard]] std::vector<RadiusShare> respond(std::span<const PerLayer<double>> optical_depths,
                                                   double fibril_radius_nm) const;

private:
    ParameterRange radius_nm_;
    std::vector<double> log_radius_;  // of each emulator
    std::vector<Emulator> emulators_;
    std::vector<double> certified_error_;  // at each wavelength
};

/// Whether one of the ranges of `domain` is that of the fibril radius.
[[nodiscard]] bool varies_fibril_radius(const EmulatorDomain& domain);

}  // namespace skinfit
