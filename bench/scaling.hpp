#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/ladder.hpp"
#include "fit/plot.hpp"

namespace skinfit {

/// What costs grow with.
struct ScalingPlot {
    std::string name;  ///< of its files
    Plot plot;
};

/// Processor times against the number of spectra, wavelengths, rays and free parameters, everything else as in
/// `bench_work`; both axes are decimal logarithms, but for free parameters. Takes about a minute.
[[nodiscard]] std::vector<ScalingPlot> measure_scaling(const BenchListener& tell);

/// Writes the lines of each plot as `scaling_<name>.csv` into `folder`. Throws InputError where that cannot be done.
void write_scaling_tables(const std::vector<ScalingPlot>& plots, const std::filesystem::path& folder);

}  // namespace skinfit
