#pragma once

#include "bench/stopwatch.hpp"
#include "bench/work.hpp"
#include "model/emulator.hpp"

namespace skinfit {

/// What intervals of six parameters cost over an emulator: those of the work, and the scale.
struct BenchIntervals {
    std::size_t spectra;
    Duration profile;                ///< median of all six intervals
    Duration posterior;              ///< median, to 1000 effective draws of every parameter
    double least_effective_draws;    ///< of any parameter in any spectrum
    std::size_t profile_parameters;  ///< 6
};

/// Over the first `count` spectra of the work.
[[nodiscard]] BenchIntervals measure_intervals(const BenchWork& work, const Emulator& emulator, std::size_t count);

}  // namespace skinfit
