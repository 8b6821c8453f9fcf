#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace skinfit {

/// Four independent uniform numbers in (0, 1), each a multiple of 2^-33.
using FourUniforms = std::array<double, 4>;

/// Four independent uniform words.
using FourWords = std::array<std::uint32_t, 4>;

/// The middle of the 2^-32 of the unit interval that a uniform word stands for.
[[nodiscard]] constexpr double to_uniform(std::uint32_t word) {
    return (word + 0.5) * 0x1p-32;
}

/// Counter-based random numbers [SALMON11]: the numbers of event e of ray i are a function of (seed, i, e, attempt)
/// alone, so a ray is the same on any machine, in any order and on any number of threads. They do not depend on the
/// wavelength nor on the sample: these are common random numbers across wavelengths and parameter changes. Two walks
/// that differ slightly stay in step event by event, since a rejection takes further attempts and not further events.
/// Seven rounds of Philox are the fewest that pass BigCrush, [SALMON11, Sec. 4].
class RandomRay {
public:
    /// The numbers of ray `ray`.
    RandomRay(std::uint64_t seed, std::uint64_t ray)
        : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}}, ray_(ray) {}

    /// The numbers of one attempt at one event.
    [[nodiscard]] FourUniforms uniforms(std::uint32_t event, std::uint32_t attempt) const {
        const FourWords drawn = words(event, attempt);
        return {to_uniform(drawn[0]), to_uniform(drawn[1]), to_uniform(drawn[2]), to_uniform(drawn[3])};
    }
    /// The same as words.
    [[nodiscard]] FourWords words(std::uint32_t event, std::uint32_t attempt) const {
        const r123::Philox4x32::ctr_type counter = {
            {static_cast<std::uint32_t>(ray_), static_cast<std::uint32_t>(ray_ >> 32U), event, attempt}};
        const r123::Philox4x32::ctr_type bits = r123::Philox4x32_R<7>{}(counter, key_);
        return {bits[0], bits[1], bits[2], bits[3]};
    }

private:
    r123::Philox4x32::key_type key_;
    std::uint64_t ray_;
};

}  // namespace skinfit
