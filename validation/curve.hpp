#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "model/goniophotometer.hpp"

/// What the figures of a paper consist of, and what claims about them are judged by.
namespace skinfit {

/// One computed spectrum.
struct SpectralCurve {
    std::string name;
    std::vector<double> wavelength_nm;  ///< at least one, ascends strictly
    std::vector<double> value;  ///< one per wavelength: reflectance or transmittance, fractions, or an extinction

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
};

/// The mean of `steps`, equal ones from the normal to the horizon, from `first` to before `last`, weighted by projected
/// solid angle; their errors are independent.
[[nodiscard]] BrdfValue mean_brdf(std::span<const BrdfValue> steps, std::size_t first, std::size_t last);

}  // namespace skinfit
