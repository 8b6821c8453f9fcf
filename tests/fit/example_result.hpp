#pragma once

#include "fit/result.hpp"

namespace skinfit::test {

/// A made-up result with a parameter of every status; its numbers belong to no computation.
[[nodiscard]] FitResult example_result();

/// The same where all is well: one free parameter, verdict consistent.
[[nodiscard]] FitResult good_result();

/// The first example with profiles, of which each leaves its parabola.
[[nodiscard]] FitResult profiled_result();

/// The consistent one with a posterior in which one step diverged: suspect.
[[nodiscard]] FitResult sampled_result();

/// The consistent one with blood of both layers of the dermis in place of melanin, their errors against each other.
[[nodiscard]] FitResult split_result();

}  // namespace skinfit::test
