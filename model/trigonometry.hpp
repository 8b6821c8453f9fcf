#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "model/constants.hpp"

/// Sines, cosines and an exponential for the walk's inner loop, open to inlining and without range reduction where the
/// range is known. Sines and cosines are Taylor series whose first neglected term is below 2e-10 in the range stated,
/// the grain of the uniform numbers they are fed with. Each is a fixed sequence of IEEE operations, so that
/// `model/group_event.cpp` can do the same on many numbers at once and give the same bits.
namespace skinfit {
namespace detail {

/// The coefficients (-1)^k / (2k + first)! of `terms` terms.
template <int terms, int first>
inline constexpr std::array<double, terms> alternating_coefficients = [] {
    std::array<double, terms> result{};
    double factorial = 1.0;  // of 2k + first
    for (int k = 0; k < terms; ++k) {
        if (k > 0) factorial *= (2.0 * k + first - 1.0) * (2.0 * k + first);
        result[static_cast<std::size_t>(k)] = (k % 2 == 0 ? 1.0 : -1.0) / factorial;
    }
    return result;
}();

/// The coefficients (-1)^k / k! of `terms` terms.
template <int terms>
inline constexpr std::array<double, terms> decay_coefficients = [] {
    std::array<double, terms> result{};
    double factorial = 1.0;
    for (int k = 0; k < terms; ++k) {
        if (k > 0) factorial *= k;
        result[static_cast<std::size_t>(k)] = (k % 2 == 0 ? 1.0 : -1.0) / factorial;
    }
    return result;
}();

/// The sum over k of coefficients[k] x^k, by Horner's rule.
template <std::size_t terms>
[[nodiscard]] constexpr double series(const std::array<double, terms>& coefficients, double x) {
    double sum = coefficients[terms - 1];
    for (std::size_t k = terms - 1; k-- > 0;) sum = sum * x + coefficients[k];
    return sum;
}

/// What `decay` adds to round to an integer, which the lowest bits then hold.
inline constexpr double rounder = 0x1.8p52;
inline constexpr double most_decay = 700.0;
inline constexpr double halvings_per_decay = 1.44269504088896340736;  // 1 / ln 2
inline constexpr double ln2_high = 0x1.62e42feep-1;  // short enough for exact products with the integers met here
inline constexpr double ln2_low = 0x1.a39ef35793c76p-33;
inline constexpr int decay_terms = 14;

}  // namespace detail

/// exp(-depth) for a depth of 0 and more, to 4e-16 of its value; beyond a depth of 700, exp(-700).
[[nodiscard]] inline double decay(double depth) {
    const double limited = depth < detail::most_decay ? depth : detail::most_decay;
    const double shifted = limited * detail::halvings_per_decay + detail::rounder;
    const double halvings = shifted - detail::rounder;
    const double rest = (limited - halvings * detail::ln2_high) - halvings * detail::ln2_low;
    const auto integer = std::bit_cast<std::uint64_t>(shifted) - std::bit_cast<std::uint64_t>(detail::rounder);
    const auto power = std::bit_cast<double>((1023 - integer) << 52U);
    return detail::series(detail::decay_coefficients<detail::decay_terms>, rest) * power;
}

/// The cosine of an angle of at most 1.2 rad.
[[nodiscard]] constexpr double small_cosine(double angle) {
    return detail::series(detail::alternating_coefficients<7, 0>, angle * angle);
}

/// The sine of an angle of at most 1.2 rad.
[[nodiscard]] constexpr double small_sine(double angle) {
    return angle * detail::series(detail::alternating_coefficients<7, 1>, angle * angle);
}

/// The cosine of `turns` full turns, 0 to 1: cos(2 pi t) = sin(2 pi (|t - 1/2| - 1/4)).
[[nodiscard]] inline double cosine_of_turns(double turns) {
    const double angle = 2.0 * pi * (std::fabs(turns - 0.5) - 0.25);
    return angle * detail::series(detail::alternating_coefficients<8, 1>, angle * angle);
}

/// The sine of `turns` full turns, 0 to 1: the cosine a quarter turn earlier.
[[nodiscard]] inline double sine_of_turns(double turns) {
    return cosine_of_turns(turns < 0.25 ? turns + 0.75 : turns - 0.25);
}

}  // namespace skinfit
