#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "model/interface_rules.hpp"
#include "model/layer_stack.hpp"
#include "model/ranked_numbers.hpp"

namespace skinfit {

/// The states that decide what happens to a ray at its next event. Rays of a batch are grouped by state, and within a
/// group ordered by their cosine's bin.
struct RayState {
    int layer;     ///< 0 to 3
    bool upward;   ///< its next interface is the upper one
    bool bounced;  ///< the printed edition's; false in the revised one, which does not ask
};

/// States as numbers: those in the sample, then the two ways out.
inline constexpr int inner_state_count = 4 * static_cast<int>(layer_count);
inline constexpr int left_through_top = inner_state_count;
inline constexpr int left_through_base = inner_state_count + 1;
inline constexpr int state_count = inner_state_count + 2;

/// The number of a state within the sample, and the state of a number.
[[nodiscard]] constexpr int number_of(const RayState& state) {
    return 4 * state.layer + (state.upward ? 2 : 0) + (state.bounced ? 1 : 0);
}
[[nodiscard]] constexpr RayState state_of(int number) {
    return {.layer = number / 4, .upward = (number & 2) != 0, .bounced = (number & 1) != 0};
}

/// Bins of the cosine within a state.
inline constexpr int cosine_bins = 16;

/// The key by which rays are ordered: state, then bin of the cosine.
[[nodiscard]] constexpr std::int32_t order_key(int state, double cosine) {
    const double bin = cosine * cosine_bins;
    return static_cast<std::int32_t>(state * cosine_bins + (bin < cosine_bins - 0.5 ? bin : cosine_bins - 0.5));
}
inline constexpr std::size_t order_key_count = static_cast<std::size_t>(state_count) * cosine_bins;

/// One interface as the rays of a group meet it, and the states they go on in.
struct MetInterface {
    InterfaceKind kind;
    FresnelInterface optics;  ///< for a Fresnel interface
    int reflected_state;
    int transmitted_state;
};

/// What all rays of a group have in common at an event.
struct EventGroup {
    const LayerStack* stack;
    RayState state;
    bool asks;            ///< for a Rayleigh test
    MetInterface ahead;   ///< in the direction of travel
    MetInterface behind;  ///< met by rays that Rayleigh scattering has turned back
};
[[nodiscard]] EventGroup group_of(const LayerStack& stack, const RayState& state);

/// The arrays of a group's rays, in their order. All are readable, and the results writable, for `SobolPoints::slack`
/// elements beyond `count`; what is written there is rubbish.
struct GroupRays {
    std::size_t count;
    const double* cosine;
    double* next_cosine;
    double* length;          ///< 1 / cosine of the run; 0 where none was completed
    std::int32_t* again;     ///< room for work
    std::int32_t* next_key;  ///< `order_key` of the state and cosine that the ray goes on with
};

/// One event of every ray of a group: `RandomWalk::follow_event` without absorption, on as many rays at once as the
/// machine's vectors hold. The same bits on every machine.
void follow_group(const EventGroup& group, const SobolPoints& points, const RankedNumbers& numbers,
                  const GroupRays& rays);

}  // namespace skinfit
