#include "fit/result.hpp"

#include <algorithm>
#include <cmath>

namespace skinfit {

bool has_own_cost(const FitResult& result) {
    return !result.priors.empty() || result.configuration.loss != Loss::squares ||
           !result.configuration.weights.empty();
}

std::optional<double> largest_difference_in_sigmas(const FitResult& result, const Minimum& other) {
    std::optional<double> largest;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const FittedParameter& fitted = result.free[i];
        if (!fitted.uncertainty.sigma) continue;
        const double difference = std::abs(other.values[i] - fitted.value) / *fitted.uncertainty.sigma;
        largest = std::max(largest.value_or(0.0), difference);
    }
    return largest;
}

std::size_t reading_count(const FitResult& result) {
    std::size_t count = 0;
    for (const FittedSpectrum& spectrum : result.spectra) count += spectrum.measured.size();
    return count;
}

}  // namespace skinfit
