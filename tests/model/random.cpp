#include "model/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

/// One line of `kat_vectors` of the Random123 distribution for `philox4x32 7`.
struct KnownAnswer {
    std::array<std::uint32_t, 4> counter;
    std::array<std::uint32_t, 2> key;
    std::array<std::uint32_t, 4> bits;
};

std::uint64_t joined(std::uint32_t low, std::uint32_t high) {
    return (static_cast<std::uint64_t>(high) << 32U) | low;
}

TEST(RandomRay, AgreesWithThePublishedAnswersOfPhilox) {
    const std::vector<KnownAnswer> answers = {
        {{0, 0, 0, 0}, {0, 0}, {0x5f6fb709, 0x0d893f64, 0x4f121f81, 0x4f730a48}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x5207ddc2, 0x45165e59, 0x4d8ee751, 0x8c52f662}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0x4dfccaba, 0x190a87f0, 0xc47362ba, 0xb6b5242a}},
    };
    for (const auto& [counter, key, bits] : answers) {
        const RandomRay random(joined(key[0], key[1]), joined(counter[0], counter[1]));
        const FourUniforms uniforms = random.uniforms(counter[2], counter[3]);
        for (std::size_t lane = 0; lane < 4; ++lane) {
            EXPECT_EQ(uniforms[lane], (static_cast<double>(bits[lane]) + 0.5) / 4294967296.0);
        }
    }
}

TEST(RandomRay, NumbersDoNotDependOnTheOrderTheyAreAskedIn) {
    const RandomRay random(7, 11);
    const FourUniforms late = random.uniforms(5, 2);
    const FourUniforms early = random.uniforms(0, 0);
    EXPECT_EQ(RandomRay(7, 11).uniforms(0, 0), early);
    EXPECT_EQ(RandomRay(7, 11).uniforms(5, 2), late);
}

TEST(RandomRay, SeedsRaysEventsAndAttemptsHaveStreamsOfTheirOwn) {
    std::set<FourUniforms> seen;
    std::size_t asked = 0;
    const std::uint64_t beyond_32_bits = 1ULL << 32U;
    for (const std::uint64_t seed : std::array<std::uint64_t, 4>{0, 1, 2, 1 + beyond_32_bits}) {
        for (const std::uint64_t ray : std::array<std::uint64_t, 5>{0, 1, 2, 3, 1 + beyond_32_bits}) {
            for (std::uint32_t event = 0; event < 20; ++event) {
                for (std::uint32_t attempt = 0; attempt < 5; ++attempt, ++asked) {
                    seen.insert(RandomRay(seed, ray).uniforms(event, attempt));
                }
            }
        }
    }
    EXPECT_EQ(seen.size(), asked);
}

TEST(RandomRay, NumbersAreInsideTheUnitInterval) {
    // The extreme words 0 and 2^32 - 1 would give these two.
    EXPECT_GT(0.5 * 0x1p-32, 0.0);
    EXPECT_LT((4294967295.0 + 0.5) * 0x1p-32, 1.0);
    for (std::uint64_t ray = 0; ray < 100'000; ++ray) {
        for (const double xi : RandomRay(3, ray).uniforms(1, 0)) {
            ASSERT_GT(xi, 0.0);
            ASSERT_LT(xi, 1.0);
            ASSERT_EQ(xi * 0x1p33, std::floor(xi * 0x1p33));
        }
    }
}

TEST(RandomRay, EveryLaneIsUniform) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
        std::vector<double> numbers;
        for (std::uint64_t ray = 0; ray < 1'000'000; ++ray) numbers.push_back(RandomRay(1, ray).uniforms(2, 0)[lane]);
        EXPECT_GT(test::uniformity_p_value(numbers), test::passing_p_value) << lane;
        for (double& number : numbers) number = std::pow(number, 1.02);
        EXPECT_LT(test::uniformity_p_value(numbers), test::passing_p_value) << "xi^1.02 passes";
    }
}

/// The p-value that pairs of numbers fill the unit square evenly, in 16 x 16 bins.
template <class First, class Second>
double pairs_p_value(First&& first, Second&& second) {
    std::vector<std::uint64_t> counts(256);
    for (std::uint64_t ray = 0; ray < 1'000'000; ++ray) {
        ++counts[16 * static_cast<std::size_t>(16 * first(ray)) + static_cast<std::size_t>(16 * second(ray))];
    }
    return test::equal_bins_p_value(counts);
}

TEST(RandomRay, NeighboursAreIndependent) {
    const auto here = [](std::uint64_t ray) { return RandomRay(1, ray).uniforms(2, 0)[0]; };
    const auto next_lane = [](std::uint64_t ray) { return RandomRay(1, ray).uniforms(2, 0)[1]; };
    const auto next_ray = [](std::uint64_t ray) { return RandomRay(1, ray + 1).uniforms(2, 0)[0]; };
    const auto next_event = [](std::uint64_t ray) { return RandomRay(1, ray).uniforms(3, 0)[0]; };
    const auto next_attempt = [](std::uint64_t ray) { return RandomRay(1, ray).uniforms(2, 1)[0]; };
    const auto next_seed = [](std::uint64_t ray) { return RandomRay(2, ray).uniforms(2, 0)[0]; };
    EXPECT_GT(pairs_p_value(here, next_lane), test::passing_p_value);
    EXPECT_GT(pairs_p_value(here, next_ray), test::passing_p_value);
    EXPECT_GT(pairs_p_value(here, next_event), test::passing_p_value);
    EXPECT_GT(pairs_p_value(here, next_attempt), test::passing_p_value);
    EXPECT_GT(pairs_p_value(here, next_seed), test::passing_p_value);
    EXPECT_LT(pairs_p_value(here, here), test::passing_p_value) << "the same stream passes as independent";
}

}  // namespace
}  // namespace skinfit
