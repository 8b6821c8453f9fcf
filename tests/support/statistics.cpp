#include "tests/support/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cassert>
#include <cmath>
#include <numbers>

namespace skinfit::test {

double chi_square_p_value(double statistic, double degrees_of_freedom) {
    const boost::math::chi_squared distribution(degrees_of_freedom);
    return boost::math::cdf(boost::math::complement(distribution, statistic));
}

double equal_bins_p_value(std::span<const std::uint64_t> counts) {
    assert(counts.size() >= 2);
    double total = 0.0;
    for (const std::uint64_t count : counts) total += static_cast<double>(count);
    const double expected = total / static_cast<double>(counts.size());
    double statistic = 0.0;
    for (const std::uint64_t count : counts) {
        const double excess = static_cast<double>(count) - expected;
        statistic += excess * excess / expected;
    }
    return chi_square_p_value(statistic, static_cast<double>(counts.size() - 1));
}

double uniformity_p_value(std::span<const double> shares) {
    constexpr std::size_t bins = 50;
    std::vector<std::uint64_t> counts(bins);
    for (const double share : shares) {
        assert(share >= 0.0 && share <= 1.0);
        ++counts[std::min(static_cast<std::size_t>(share * bins), bins - 1)];
    }
    return equal_bins_p_value(counts);
}

double two_sided_p_value(double z) {
    return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

double family_wise_p_value(std::span<const double> z) {
    double smallest = 1.0;
    for (const double value : z) {
        // A NaN is a failure, not a pass.
        smallest = std::isnan(value) ? 0.0 : std::min(smallest, two_sided_p_value(value));
    }
    return std::min(1.0, smallest * static_cast<double>(z.size()));
}

Estimate share_of(std::uint64_t count, std::uint64_t trials) {
    const auto n = static_cast<double>(trials);
    const double share = static_cast<double>(count) / n;
    return {.value = share, .standard_error = std::sqrt(share * (1.0 - share) / n)};
}

double z_between(const Estimate& a, const Estimate& b) {
    const double difference = a.value - b.value;
    return difference == 0.0 ? 0.0 : difference / std::hypot(a.standard_error, b.standard_error);
}

double z_between(const Count& a, const Count& b) {
    const auto na = static_cast<double>(a.trials);
    const auto nb = static_cast<double>(b.trials);
    const double difference = static_cast<double>(a.count) / na - static_cast<double>(b.count) / nb;
    if (difference == 0.0) return 0.0;
    const double pooled = static_cast<double>(a.count + b.count) / (na + nb);
    return difference / std::sqrt(pooled * (1.0 - pooled) * (1.0 / na + 1.0 / nb));
}

}  // namespace skinfit::test
