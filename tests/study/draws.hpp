#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "model/random.hpp"

namespace skinfit::test {

/// Independent draws, one after the other, the same for the same seed on any machine.
class Draws {
public:
    explicit Draws(std::uint64_t seed) : ray_(seed, 0) {}

    /// In (0, 1).
    [[nodiscard]] double uniform() { return ray_.uniforms(event_++, 0)[0]; }

    /// Standard normal.
    [[nodiscard]] double normal() {
        const FourUniforms u = ray_.uniforms(event_++, 0);
        return std::sqrt(-2.0 * std::log(u[0])) * std::cos(2.0 * std::numbers::pi * u[1]);
    }

private:
    RandomRay ray_;
    std::uint32_t event_ = 0;
};

}  // namespace skinfit::test
