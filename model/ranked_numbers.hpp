#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/random.hpp"

namespace skinfit {

/// The first points of a Sobol sequence in four dimensions, one array of words per dimension. Each array is readable
/// for `slack` words more.
class SobolPoints {
public:
    static constexpr std::size_t slack = 64;

    /// `count` points, at most 2^32.
    explicit SobolPoints(std::size_t count);

    /// The words of dimension `which`, 0 to 3, one of each point.
    [[nodiscard]] const std::uint32_t* dimension(std::size_t which) const { return words_.data() + which * stride_; }

private:
    std::size_t stride_;
    std::vector<std::uint32_t> words_;
};

/// The numbers that rays in one state share out among them at one event of a batch: the ray of rank r gets point r of a
/// Sobol sequence, every dimension shifted (by exclusive or) by a word that is drawn anew for each batch, event, state
/// and attempt. The shift makes each ray's numbers uniform and independent of its past, hence every mean unbiased; the
/// sequence spreads the numbers of rays of neighbouring rank, which are alike, evenly. [LECUYER08]
class RankedNumbers {
public:
    /// Which numbers: at most 2^32 batches, 16 states.
    struct Draw {
        std::uint64_t seed;
        std::uint32_t batch;
        std::uint32_t event;
        std::uint32_t state;
    };
    /// The numbers that `draw` names.
    explicit RankedNumbers(const Draw& draw)
        : random_(draw.seed, (std::uint64_t{1} << 63U) | std::uint64_t{draw.state} << 32U | draw.batch),
          event_(draw.event) {}

    /// The words that shift the points. Their streams are not those of any ray of a `RandomRay` walk.
    [[nodiscard]] FourWords shift(std::uint32_t attempt) const { return random_.words(event_, attempt); }

private:
    RandomRay random_;
    std::uint32_t event_;
};

}  // namespace skinfit
