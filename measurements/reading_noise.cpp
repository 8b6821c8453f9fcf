#include "measurements/reading_noise.hpp"

#include <algorithm>
#include <cmath>

namespace skinfit {

double reading_noise(const Spectrum& spectrum) {
    constexpr std::size_t fewest = 5;
    constexpr double sigma_per_median = 1.4826;  // of the absolute values of normal numbers
    if (spectrum.value.size() < fewest) return 0;
    std::vector<double> departure;
    for (std::size_t i = 1; i + 1 < spectrum.value.size(); ++i) {
        if (spectrum.wavelength_nm[i - 1] == spectrum.wavelength_nm[i + 1])
            continue;  // three readings at one wavelength
        const double share = (spectrum.wavelength_nm[i] - spectrum.wavelength_nm[i - 1]) /
                             (spectrum.wavelength_nm[i + 1] - spectrum.wavelength_nm[i - 1]);
        const double before = (1 - share) * spectrum.value[i - 1];
        const double after = share * spectrum.value[i + 1];
        // Independent noise of the three readings adds up to this many times the variance of one.
        const double variances = 1 + (1 - share) * (1 - share) + share * share;
        departure.push_back(std::abs(spectrum.value[i] - before - after) / std::sqrt(variances));
    }
    if (departure.empty()) return 0;
    const auto middle = departure.begin() + static_cast<std::ptrdiff_t>(departure.size() / 2);
    std::ranges::nth_element(departure, middle);
    return sigma_per_median * *middle;
}

}  // namespace skinfit
