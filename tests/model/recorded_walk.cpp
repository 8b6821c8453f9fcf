#include "model/recorded_walk.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "model/group_event.hpp"

namespace skinfit {
namespace {

constexpr RecordedBatch batch{.refracted_cosine = 0.9, .rays = 3000, .seed = 5, .number = 2};

const SobolPoints& points() {
    static const SobolPoints all(batch.rays);
    return all;
}

FourUniforms shifted_point(const RankedNumbers& numbers, std::uint32_t attempt, std::size_t rank) {
    const FourWords shift = numbers.shift(attempt);
    FourUniforms xi{};
    for (std::size_t i = 0; i < 4; ++i) xi[i] = to_uniform(points().dimension(i)[rank] ^ shift[i]);
    return xi;
}

/// The numbers a ray has been given for one event, attempt by attempt. One attempt more is noticed, and answered by
/// numbers that any scattering accepts.
struct GivenNumbers {
    std::vector<FourUniforms> attempts;
    bool* wants_more = nullptr;

    [[nodiscard]] FourUniforms uniforms(std::uint32_t /*event*/, std::uint32_t attempt) const {
        if (attempt < attempts.size()) return attempts[attempt];
        *wants_more = true;
        return {0x1p-33, 0.5, 0.5, 0.5};
    }
};

using Walk = BasicRandomWalk<IgnoredAzimuth, GivenNumbers>;

struct Walker {
    Walk walk;
    RecordedRay* recorded;
};

/// One event of the rays of one group, which are in order. Rays that turn back in a forward layer share out the numbers
/// of the next attempt.
std::vector<Walker> follow(const std::vector<Walker>& group, const RankedNumbers& numbers, std::uint32_t event) {
    std::vector<std::size_t> trying(group.size());
    for (std::size_t i = 0; i < group.size(); ++i) trying[i] = i;
    std::vector<std::vector<FourUniforms>> given(group.size());
    std::vector<std::optional<Walker>> followed(group.size());
    for (std::uint32_t attempt = 0; !trying.empty(); ++attempt) {
        std::vector<std::size_t> still_trying;
        for (std::size_t rank = 0; rank < trying.size(); ++rank) {
            const std::size_t i = trying[rank];
            given[i].push_back(shifted_point(numbers, attempt, rank));
            bool wants_more = false;
            Walker walker = group[i];
            RecordedRay result = *walker.recorded;
            walker.walk.set_random({given[i], &wants_more});
            const std::optional<Exit> exit =
                walker.walk.follow_event(event, given[i][0], [&](int layer, double cosine, double) {
                    result.lengths[static_cast<std::size_t>(layer)] += 1.0 / cosine;
                    return true;
                });
            if (wants_more) {
                still_trying.push_back(i);
                continue;
            }
            *walker.recorded = result;
            if (exit) {
                walker.recorded->exit = *exit;
            } else {
                followed[i] = walker;
            }
        }
        trying = still_trying;
    }
    std::vector<Walker> under_way;
    for (const auto& walker : followed) {
        if (walker) under_way.push_back(*walker);
    }
    return under_way;
}

int state_number(const Walk& walk, Edition edition) {
    const auto state = walk.state();
    return number_of(
        {.layer = state.layer, .upward = state.upward, .bounced = edition == Edition::printed && state.bounced});
}

/// What `record_batch` promises, ray by ray with the scalar walk.
std::vector<RecordedRay> obviously_recorded(const LayerStack& stack) {
    std::vector<RecordedRay> recorded(batch.rays);
    std::vector<Walker> walkers;
    for (RecordedRay& ray : recorded) {
        walkers.push_back({Walk(stack, GivenNumbers{}), &ray});
        walkers.back().walk.enter(batch.refracted_cosine);
    }
    for (std::uint32_t event = 1; !walkers.empty(); ++event) {
        std::map<int, std::vector<Walker>> groups;
        for (const Walker& walker : walkers) groups[state_number(walker.walk, stack.edition)].push_back(walker);
        walkers.clear();
        for (const auto& [state, group] : groups) {
            const RankedNumbers numbers({.seed = batch.seed,
                                         .batch = batch.number,
                                         .event = event,
                                         .state = static_cast<std::uint32_t>(state)});
            std::ranges::copy(follow(group, numbers, event), std::back_inserter(walkers));
        }
        std::ranges::stable_sort(walkers, {}, [&](const Walker& walker) {
            return order_key(state_number(walker.walk, stack.edition), walker.walk.state().cosine);
        });
    }
    return recorded;
}

/// The bits of a recording.
using Bits = std::vector<std::tuple<PerLayer<double>, Exit>>;

Bits bits_of(const std::vector<RecordedRay>& rays) {
    Bits bits;
    for (const RecordedRay& ray : rays) bits.emplace_back(ray.lengths, ray.exit);
    return bits;
}

std::vector<Sample> all_kinds_of_samples() {
    std::vector<Sample> samples;
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        for (const int layers : {2, 4}) {
            for (const Base& base :
                 {Base{Base::Kind::hypodermis}, Base{Base::Kind::matched}, Base{Base::Kind::index, 1.44}}) {
                samples.push_back({.skin = {}, .edition = edition, .layers = layers, .base = base});
            }
        }
    }
    return samples;
}

TEST(RecordedWalk, IsTheScalarWalkBitByBitOnEveryInstructionSet) {
    const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    for (const Sample& sample : all_kinds_of_samples()) {
        for (const double wavelength_nm : {420.0, 660.0}) {
            const LayerStack stack = layer_stack(sample, wavelength_nm);
            const Bits expected = bits_of(obviously_recorded(stack));
            for (const std::int64_t target : targets) {
                hwy::SetSupportedTargetsForTest(target);
                EXPECT_EQ(bits_of(record_batch(stack, batch, points())), expected) << hwy::TargetName(target);
            }
            hwy::SetSupportedTargetsForTest(0);
        }
    }
}

}  // namespace
}  // namespace skinfit
