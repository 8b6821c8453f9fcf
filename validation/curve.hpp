#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/goniophotometer.hpp"

/// What the figures of a paper consist of, and what claims about them are judged by.
namespace skinfit {

/// One computed spectrum.
struct SpectralCurve {
    std::string name;
    std::vector<double> wavelength_nm;  ///< at least one, ascends strictly
    std::vector<double> value;          ///< reflectance or transmittance, fractions, one per wavelength

    /// Linear between its wavelengths; asserts that `at_nm` lies within them.
    [[nodiscard]] double at(double at_nm) const;
};

/// How light leaves on one side, in equal steps of the angle to the normal.
struct AngularCurve {
    std::string name;
    double incidence_deg = 0.0;
    std::vector<BrdfValue> ring;      ///< means over azimuth, from the normal to the horizon
    std::vector<BrdfValue> forward;   ///< in the half plane of incidence away from the light, as many
    std::vector<BrdfValue> backward;  ///< in the half plane of incidence towards the light, as many

    /// The angle to the normal at which step `i` begins, 0 to `ring.size()`.
    [[nodiscard]] double edge_deg(std::size_t i) const;
    /// The mean over the steps `first` to before `last`, weighted by projected solid angle; 1/sr.
    [[nodiscard]] double mean(std::size_t first, std::size_t last) const;
};

}  // namespace skinfit
