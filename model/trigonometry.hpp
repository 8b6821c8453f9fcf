#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "model/constants.hpp"

/// Sines and cosines for the walk's inner loop, without range reduction and open to inlining: Taylor series whose
/// first neglected term is below 2e-10 in the range stated, the grain of the uniform numbers they are fed with.
namespace skinfit {
namespace detail {

/// The series sum over k of (-1)^k x^k / (2k + first)!, `terms` terms, by Horner's rule.
template <int terms, int first>
[[nodiscard]] constexpr double alternating_series(double x) {
    constexpr std::array<double, terms> coefficients = [] {
        std::array<double, terms> result{};
        double factorial = 1.0;  // of 2k + first
        for (int k = 0; k < terms; ++k) {
            if (k > 0) factorial *= (2.0 * k + first - 1.0) * (2.0 * k + first);
            result[static_cast<std::size_t>(k)] = (k % 2 == 0 ? 1.0 : -1.0) / factorial;
        }
        return result;
    }();
    double sum = 0.0;
    for (std::size_t k = terms; k-- > 0;) sum = sum * x + coefficients[k];
    return sum;
}

}  // namespace detail

/// The cosine of an angle of at most 1.2 rad.
[[nodiscard]] constexpr double small_cosine(double angle) {
    return detail::alternating_series<7, 0>(angle * angle);
}

/// The sine of an angle of at most 1.2 rad.
[[nodiscard]] constexpr double small_sine(double angle) {
    return angle * detail::alternating_series<7, 1>(angle * angle);
}

/// The cosine of `turns` full turns, 0 to 1: cos(2 pi t) = sin(2 pi (|t - 1/2| - 1/4)).
[[nodiscard]] inline double cosine_of_turns(double turns) {
    const double angle = 2.0 * pi * (std::fabs(turns - 0.5) - 0.25);
    return angle * detail::alternating_series<8, 1>(angle * angle);
}

/// The sine of `turns` full turns, 0 to 1: the cosine a quarter turn earlier.
[[nodiscard]] inline double sine_of_turns(double turns) {
    return cosine_of_turns(turns < 0.25 ? turns + 0.75 : turns - 0.25);
}

}  // namespace skinfit
