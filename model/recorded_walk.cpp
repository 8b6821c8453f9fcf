#include "model/recorded_walk.hpp"

#include <algorithm>
#include <utility>

#include "core/stop.hpp"
#include "model/group_event.hpp"

namespace skinfit {
namespace {

/// The rays under way, ordered by key and, within a key, as before.
struct Order {
    explicit Order(std::size_t rays) : cosine(rays + SobolPoints::slack, 1.0), ray(rays) {}
    std::vector<double> cosine;
    std::vector<std::uint32_t> ray;
};

using KeyCounts = std::array<std::uint32_t, order_key_count + 1>;

}  // namespace

std::vector<RecordedRay> record_batch(const LayerStack& stack, const RecordedBatch& batch, const SobolPoints& points,
                                      const std::stop_token& stop) {
    std::vector<EventGroup> groups;
    for (int state = 0; state < 4 * stack.layers; ++state) groups.push_back(group_of(stack, state_of(state)));
    std::vector<RecordedRay> recorded(batch.rays);
    Order now(batch.rays);
    Order next(batch.rays);
    std::vector<double> next_cosine(batch.rays + SobolPoints::slack);
    std::vector<double> length(batch.rays + SobolPoints::slack);
    std::vector<std::int32_t> again(batch.rays + SobolPoints::slack);
    std::vector<std::int32_t> next_key(batch.rays + SobolPoints::slack);
    std::ranges::fill(now.cosine, batch.refracted_cosine);
    for (std::size_t i = 0; i < batch.rays; ++i) now.ray[i] = static_cast<std::uint32_t>(i);
    std::array<std::uint32_t, inner_state_count + 1> begins;  // of the groups
    begins.fill(static_cast<std::uint32_t>(batch.rays));
    begins[0] = 0;
    for (std::uint32_t event = 1; begins.back() > 0; ++event) {
        leave_if_cancelled(stop);
        KeyCounts begin_of_key{};
        for (std::size_t state = 0; state < groups.size(); ++state) {
            const std::uint32_t begin = begins[state];
            const std::uint32_t end = begins[state + 1];
            if (begin == end) continue;
            const RankedNumbers numbers({.seed = batch.seed,
                                         .batch = batch.number,
                                         .event = event,
                                         .state = static_cast<std::uint32_t>(state)});
            follow_group(groups[state], points, numbers,
                         {.count = end - begin,
                          .cosine = now.cosine.data() + begin,
                          .next_cosine = next_cosine.data() + begin,
                          .length = length.data() + begin,
                          .again = again.data(),
                          .next_key = next_key.data() + begin});
            const auto layer = static_cast<std::size_t>(groups[state].state.layer);
            for (std::uint32_t i = begin; i < end; ++i) {
                recorded[now.ray[i]].lengths[layer] += length[i];
                ++begin_of_key[static_cast<std::size_t>(next_key[i]) + 1];
            }
        }
        for (std::size_t key = 1; key < begin_of_key.size(); ++key) begin_of_key[key] += begin_of_key[key - 1];
        const std::uint32_t under_way = begins.back();
        for (std::size_t state = 0; state <= inner_state_count; ++state) {
            begins[state] = begin_of_key[state * cosine_bins];
        }
        const std::uint32_t transmitted = begin_of_key[std::size_t{left_through_base} * cosine_bins];
        for (std::uint32_t i = 0; i < under_way; ++i) {
            const std::uint32_t place = begin_of_key[static_cast<std::size_t>(next_key[i])]++;
            next.cosine[place] = next_cosine[i];
            next.ray[place] = now.ray[i];
        }
        for (std::uint32_t i = begins.back(); i < under_way; ++i) {
            recorded[next.ray[i]].exit = i < transmitted ? Exit::reflected : Exit::transmitted;
        }
        std::swap(now, next);
    }
    return recorded;
}

}  // namespace skinfit
