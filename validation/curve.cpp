#include "validation/curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "model/constants.hpp"

namespace skinfit {

double SpectralCurve::at(double at_nm) const {
    assert(!wavelength_nm.empty() && at_nm >= wavelength_nm.front() && at_nm <= wavelength_nm.back());
    const auto above = std::ranges::lower_bound(wavelength_nm, at_nm);
    const auto right = static_cast<std::size_t>(above - wavelength_nm.begin());
    if (*above == at_nm) return value[right];
    const double share = (at_nm - wavelength_nm[right - 1]) / (wavelength_nm[right] - wavelength_nm[right - 1]);
    return value[right - 1] + share * (value[right] - value[right - 1]);
}

double AngularCurve::edge_deg(std::size_t i) const {
    return 90.0 * static_cast<double>(i) / static_cast<double>(ring.size());
}

BrdfValue mean_brdf(std::span<const BrdfValue> steps, std::size_t first, std::size_t last) {
    assert(first < last && last <= steps.size());
    const double step_rad = 0.5 * pi / static_cast<double>(steps.size());
    double light = 0.0;
    double variance = 0.0;
    double whole = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        const double solid_angle = std::pow(std::sin(step_rad * static_cast<double>(i + 1)), 2) -
                                   std::pow(std::sin(step_rad * static_cast<double>(i)), 2);
        light += solid_angle * steps[i].per_sr;
        variance += std::pow(solid_angle * steps[i].standard_error, 2);
        whole += solid_angle;
    }
    return {.per_sr = light / whole, .standard_error = std::sqrt(variance) / whole};
}

}  // namespace skinfit
