#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "model/skin.hpp"

namespace skinfit::test {

/// Counts of a walk; they sum to the number of rays.
struct ObviousCounts {
    std::uint64_t surface = 0;
    std::uint64_t subsurface = 0;
    std::uint64_t transmitted = 0;
    std::array<std::uint64_t, 4> absorbed{};
};

/// When a run in the dermis asks for the Rayleigh test, `../shared/design/model.md` section 3.
enum class RayleighRule { until_bounced, downward };

/// A ray that has left the sample: through which way out, and where to. z points up, out of the skin; the light came
/// along x.
enum class WayOut { surface, subsurface, transmitted };
struct ObviousExit {
    WayOut way_out;
    double x, y, z;
};

/// What to follow.
struct ObviousTask {
    Sample sample;
    double wavelength_nm;
    double incidence_rad;
    std::uint64_t rays;
    std::uint64_t seed;
    RayleighRule rule;
    std::function<void(const ObviousExit&)> on_exit{};  ///< may be empty; the folds warp directions only for this
};

/// The walk of [KA04] written as plainly as can be, with vectors in space, from `../shared/design/model.md` alone: the
/// slow reference for `random_walk`. It shares nothing with it but the measured tables.
[[nodiscard]] ObviousCounts obvious_walk(const ObviousTask& task);

}  // namespace skinfit::test
