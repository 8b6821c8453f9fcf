#include "fit/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fit/configuration_json.hpp"
#include "fit/prior.hpp"

namespace skinfit {

bool is_upper_limit(const FittedParameter& fitted) {
    return fitted.uncertainty.status == Status::at_lower_bound && fitted.bounds.lower == 0.0 &&
           may_be_absent(fitted.parameter);
}

bool has_own_cost(const FitResult& result) {
    return !result.priors.empty() || result.configuration.loss != Loss::squares ||
           !result.configuration.weights.empty();
}

std::string_view cost_name(const FitResult& result) {
    return has_own_cost(result) ? "cost" : "chi2";
}

std::string cost_words(const FitResult& result) {
    const Configuration& configuration = result.configuration;
    const std::size_t weights = configuration.weights.size();
    const std::size_t priors = result.priors.size();
    std::vector<std::string> parts;
    if (configuration.loss != Loss::squares) {
        parts.push_back(fmt::format("with loss {}", to_json(configuration)["loss"].get<std::string>()));
    }
    if (weights > 0) parts.push_back(fmt::format("with weights in {} range{}", weights, weights == 1 ? "" : "s"));
    if (priors > 0) parts.push_back(fmt::format("plus what {} prior{}", priors, priors == 1 ? " adds" : "s add"));
    return fmt::format("chi2{}{}", parts.empty() ? "" : " ", fmt::join(parts, ", "));
}

std::optional<double> largest_difference_in_sigmas(const FitResult& result, const Minimum& other) {
    std::optional<double> largest;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const FittedParameter& fitted = result.free[i];
        if (!fitted.uncertainty.sigma) continue;
        const double difference =
            natural_coordinate(fitted.prior, other.values[i]) - natural_coordinate(fitted.prior, fitted.value);
        const double sigma = *fitted.uncertainty.sigma * coordinate_slope(fitted.prior, fitted.value);
        largest = std::max(largest.value_or(0.0), std::abs(difference) / sigma);
    }
    return largest;
}

std::size_t reading_count(const FitResult& result) {
    std::size_t count = 0;
    for (const FittedSpectrum& spectrum : result.spectra) count += spectrum.measured.size();
    return count;
}

}  // namespace skinfit
