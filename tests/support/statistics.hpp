#pragma once

#include <cstdint>
#include <span>
#include <vector>

/// Statistical tests of samplers and walks. A test passes above `passing_p_value`; its seed is fixed, so it cannot
/// fail by chance from one run to the next.
namespace skinfit::test {

/// The false-alarm rate of one statistical test, fixed once when its seed was chosen.
inline constexpr double passing_p_value = 1e-6;

/// The probability that a chi-square variable of `degrees_of_freedom` exceeds `statistic`.
[[nodiscard]] double chi_square_p_value(double statistic, double degrees_of_freedom);

/// Pearson's test that all bins are equally probable: the p-value of `counts`.
[[nodiscard]] double equal_bins_p_value(std::span<const std::uint64_t> counts);

/// Pearson's test that `shares`, 0 to 1, are uniform, in 50 equal bins.
[[nodiscard]] double uniformity_p_value(std::span<const double> shares);

/// The probability that a standard normal variable lies farther from zero than `z`.
[[nodiscard]] double two_sided_p_value(double z);

/// The p-value of the worst of `z` among all of them, by Bonferroni: valid however the values are correlated.
[[nodiscard]] double family_wise_p_value(std::span<const double> z);

/// A mean and its standard error.
struct Estimate {
    double value;
    double standard_error;
};

/// The share of `count` in `trials`, with its binomial standard error.
[[nodiscard]] Estimate share_of(std::uint64_t count, std::uint64_t trials);

/// The difference of two independent estimates in units of its standard error; zero where they are equal, infinite
/// where they differ without error.
[[nodiscard]] double z_between(const Estimate& a, const Estimate& b);

/// The z of two counts of equal probability, with the pooled standard error.
struct Count {
    std::uint64_t count;
    std::uint64_t trials;
};
[[nodiscard]] double z_between(const Count& a, const Count& b);

}  // namespace skinfit::test
