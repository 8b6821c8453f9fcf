#include "measurements/interpolation.hpp"

#include <algorithm>
#include <cassert>

namespace skinfit {

double value_at(const Spectrum& spectrum, double at_nm) {
    const auto above = std::ranges::lower_bound(spectrum.wavelength_nm, at_nm);
    assert(above != spectrum.wavelength_nm.end());
    const auto i = static_cast<std::size_t>(above - spectrum.wavelength_nm.begin());
    if (*above == at_nm) return spectrum.value[i];
    assert(i > 0);
    const double below_nm = spectrum.wavelength_nm[i - 1];
    const double share = (at_nm - below_nm) / (*above - below_nm);
    return spectrum.value[i - 1] + share * (spectrum.value[i] - spectrum.value[i - 1]);
}

}  // namespace skinfit
