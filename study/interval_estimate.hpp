#pragma once

#include <cstddef>

#include "fit/configuration.hpp"

namespace skinfit {

/// An estimate and its 95 % confidence interval.
struct IntervalEstimate {
    double value;
    Bounds interval_95;
};

/// So many of so many, with Wilson's 95 % interval of the probability behind it [WILSON27].
struct Proportion {
    std::size_t count;
    std::size_t trials;
    Bounds interval_95;

    /// Of the trials, 0 to 1; there must be one.
    [[nodiscard]] double share() const { return static_cast<double>(count) / static_cast<double>(trials); }
};

/// `count` of `trials`, which is 1 at least and no less than `count`.
[[nodiscard]] Proportion proportion(std::size_t count, std::size_t trials);

/// 1.96: the normal deviate that 2.5 % exceed.
[[nodiscard]] double normal_deviate_95();

/// The deviate of Student's t that 2.5 % exceed, of `degrees_of_freedom` above 0.
[[nodiscard]] double student_deviate_95(double degrees_of_freedom);

/// The probability that a standard normal variable lies farther from zero than `z`.
[[nodiscard]] double two_sided_normal_p_value(double z);

/// The probability that a chi-square variable of `degrees_of_freedom` exceeds `statistic`.
[[nodiscard]] double upper_chi_square_p_value(double statistic, double degrees_of_freedom);

/// How much larger or smaller than an estimate the standard deviation behind it may be: the 95 % interval of true over
/// estimated for normal scatter of `degrees_of_freedom`, from chi-square.
[[nodiscard]] Bounds standard_deviation_factors_95(double degrees_of_freedom);

}  // namespace skinfit
