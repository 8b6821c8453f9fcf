#include "model/band.hpp"

#include "model/table.hpp"

namespace skinfit {

std::vector<double> band_weights(const std::vector<double>& wavelengths_nm, BandIlluminant illuminant) {
    std::vector<double> weights(wavelengths_nm.size(), 1.0);
    if (illuminant == BandIlluminant::equal_energy) return weights;
    const Curve power(embedded_table("cie_d65"), "d65");
    const Curve efficiency(embedded_table("cie_observers"), "y2");
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] = power(wavelengths_nm[i]);
        if (illuminant == BandIlluminant::d65_v) weights[i] *= efficiency(wavelengths_nm[i]);
    }
    return weights;
}

}  // namespace skinfit
