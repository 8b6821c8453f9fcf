#include "study/marginal.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cassert>
#include <cmath>
#include <utility>

#include "fit/prior.hpp"

namespace skinfit {
namespace {

constexpr std::size_t parts = 200;  // of the probability
constexpr double far = 6.0;         // standard deviations

/// Quantiles of two half normal distributions, each with its own scale and as much probability as its scale's share,
/// so that the density is continuous where they meet, cut at `bounds`.
std::vector<double> split_normal(double centre, double below, double above, const Bounds& bounds) {
    const boost::math::normal standard;
    const auto distribution = [&](double x) {
        const double share = below / (below + above);
        if (x < centre) return below > 0.0 ? 2.0 * share * cdf(standard, (x - centre) / below) : 0.0;
        return above > 0.0 ? share + (1.0 - share) * (2.0 * cdf(standard, (x - centre) / above) - 1.0) : 1.0;
    };
    const auto inverse = [&](double probability) {
        const double share = below / (below + above);
        if (probability < share) return centre + below * quantile(standard, probability / (2.0 * share));
        return centre + above * quantile(standard, 0.5 + (probability - share) / (2.0 * (1.0 - share)));
    };
    const double lowest = distribution(bounds.lower);
    const double highest = distribution(bounds.upper);
    std::vector<double> quantiles = {bounds.lower};
    for (std::size_t k = 1; k < parts; ++k) {
        const double probability = lowest + (highest - lowest) * static_cast<double>(k) / static_cast<double>(parts);
        quantiles.push_back(std::clamp(inverse(probability), bounds.lower, bounds.upper));
    }
    quantiles.push_back(bounds.upper);
    return quantiles;
}

ParameterEstimate in_natural_coordinate(ParameterEstimate estimate) {
    if (estimate.sigma) *estimate.sigma *= coordinate_slope(estimate.prior, estimate.value);
    for (double* const value : {&estimate.value, &estimate.interval_95.lower, &estimate.interval_95.upper,
                                &estimate.bounds.lower, &estimate.bounds.upper}) {
        *value = natural_coordinate(estimate.prior, *value);
    }
    return estimate;
}

/// Of the distribution that value, sigma and interval tell, all in the natural coordinate.
std::optional<std::vector<double>> natural_quantiles(const ParameterEstimate& estimate) {
    const boost::math::normal standard;
    const double two_sided_95 = quantile(standard, 0.975);
    const double one_sided_95 = quantile(standard, 0.95);  // its square is by how much the cost has risen there
    const Bounds& interval = estimate.interval_95;
    const Bounds& bounds = estimate.bounds;
    const double value = estimate.value;
    switch (estimate.status) {
        case Status::not_identifiable:
            return std::nullopt;
        case Status::at_lower_bound:
            if (interval.upper >= bounds.upper) return std::nullopt;  // any value may be
            return split_normal(value, 0.0, (interval.upper - value) / one_sided_95, bounds);
        case Status::at_upper_bound:
            if (interval.lower <= bounds.lower) return std::nullopt;
            return split_normal(value, (value - interval.lower) / one_sided_95, 0.0, bounds);
        default:
            break;
    }
    // An end of the interval at a bound says nothing of the scale.
    std::optional<double> below = estimate.sigma;
    std::optional<double> above = estimate.sigma;
    if (interval.lower > bounds.lower) below = (value - interval.lower) / two_sided_95;
    if (interval.upper < bounds.upper) above = (interval.upper - value) / two_sided_95;
    if (!below) below = above;
    if (!above) above = below;
    if (!below) return std::nullopt;  // the interval is the whole range
    return split_normal(value, *below, *above, bounds);
}

}  // namespace

MarginalDistribution::MarginalDistribution(std::vector<double> quantiles) : quantiles_(std::move(quantiles)) {
    assert(quantiles_.size() >= 2 && std::ranges::is_sorted(quantiles_));
}

double MarginalDistribution::probability_above(double threshold) const {
    if (threshold < quantiles_.front()) return 1.0;
    if (threshold >= quantiles_.back()) return 0.0;
    const auto above = std::ranges::upper_bound(quantiles_, threshold);
    const auto place = static_cast<double>(above - quantiles_.begin() - 1);
    const double low = *(above - 1);
    const double share = (threshold - low) / (*above - low);
    return 1.0 - (place + share) / static_cast<double>(quantiles_.size() - 1);
}

double MarginalDistribution::probability_above(const MarginalDistribution& other) const {
    // The mean, over slices of equal probability of the other, of the probability above their middle.
    double sum = 0.0;
    const std::vector<double>& theirs = other.quantiles_;
    for (std::size_t k = 1; k < theirs.size(); ++k) sum += probability_above((theirs[k - 1] + theirs[k]) / 2.0);
    return sum / static_cast<double>(theirs.size() - 1);
}

std::optional<MarginalDistribution> marginal_of(const ParameterEstimate& estimate) {
    if (!estimate.quantiles.empty()) return MarginalDistribution(estimate.quantiles);
    std::optional<std::vector<double>> quantiles = natural_quantiles(in_natural_coordinate(estimate));
    if (!quantiles) return std::nullopt;
    for (double& each : *quantiles) {
        each = std::clamp(value_at_coordinate(estimate.prior, each), estimate.bounds.lower, estimate.bounds.upper);
    }
    return MarginalDistribution(std::move(*quantiles));
}

std::optional<MarginalDistribution> marginal_of(const TissueValue& estimate) {
    if (!estimate.quantiles.empty()) return MarginalDistribution(estimate.quantiles);
    if (!estimate.interval_95) return std::nullopt;
    const auto [lower, upper] = *estimate.interval_95;
    const double two_sided_95 = quantile(boost::math::normal(), 0.975);
    if (!(estimate.value > 0.0)) {
        if (!(upper > 0.0)) return std::nullopt;
        const double above = upper / two_sided_95;
        return MarginalDistribution(split_normal(0.0, 0.0, above, {.lower = 0.0, .upper = far * above}));
    }
    const double centre = std::log(estimate.value);
    const double above = std::log(upper / estimate.value) / two_sided_95;
    const double below = lower > 0.0 ? std::log(estimate.value / lower) / two_sided_95 : above;
    if (!(above > 0.0 && below > 0.0)) return std::nullopt;
    std::vector<double> quantiles =
        split_normal(centre, below, above, {.lower = centre - far * below, .upper = centre + far * above});
    for (double& each : quantiles) each = std::exp(each);
    return MarginalDistribution(std::move(quantiles));
}

MarginalDistribution marginal_of(const IndexValue& index) {
    const boost::math::normal distribution(index.value, index.sigma);
    std::vector<double> quantiles = {index.value - far * index.sigma};
    for (std::size_t k = 1; k < parts; ++k) {
        quantiles.push_back(quantile(distribution, static_cast<double>(k) / static_cast<double>(parts)));
    }
    quantiles.push_back(index.value + far * index.sigma);
    return MarginalDistribution(std::move(quantiles));
}

}  // namespace skinfit
