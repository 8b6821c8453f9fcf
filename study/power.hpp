#pragma once

#include <cstddef>
#include <optional>

/// What a comparison of two groups can show: two-sided two-sample t test, exact by the noncentral t distribution
/// [COHEN88, Ch. 2].
namespace skinfit {

/// A planned comparison of two groups of equal size. Standard deviations are those of estimates, as `repeatability`
/// reports them; together above 0.
struct TwoGroupDesign {
    double between_subject_sd;  ///< of estimates of different subjects of a group, without measurement error
    double measurement_sd;      ///< of estimates of one subject
    std::size_t repeats = 1;    ///< measurements per subject, averaged; they make only `measurement_sd` smaller
    double slope = 1.0;         ///< how much of a true difference estimates show: below 1 for shrinkage by priors
    double significance_level = 0.05;  ///< two-sided, 1e-5 or more
};

/// Of the mean estimate of one subject: sqrt(between_subject_sd^2 + measurement_sd^2 / repeats).
[[nodiscard]] double subject_sd(const TwoGroupDesign& design);

/// The probability that the test with `subjects_per_group`, 2 or more, finds `true_difference` of the group means, to
/// either side.
[[nodiscard]] double power_of(const TwoGroupDesign& design, std::size_t subjects_per_group, double true_difference);

/// The true difference that `subjects_per_group`, 2 or more, find with probability `power`, above the significance
/// level and below 1. None where `slope` is 0.
[[nodiscard]] std::optional<double> detectable_difference(const TwoGroupDesign& design, std::size_t subjects_per_group,
                                                          double power);

/// The fewest subjects per group that find `true_difference` with probability `power`, as above. None where a million
/// do not suffice.
[[nodiscard]] std::optional<std::size_t> subjects_needed(const TwoGroupDesign& design, double true_difference,
                                                         double power);

}  // namespace skinfit
