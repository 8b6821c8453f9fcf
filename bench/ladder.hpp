#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/intervals.hpp"
#include "bench/stopwatch.hpp"

namespace skinfit {

/// How much is measured.
struct BenchSizes {
    std::size_t spectra = 100;
    std::uint64_t rays = 100'000;
    std::size_t solver_spectra = 20;   ///< fitted by the solver and as `fit_spectrum` searches over paths, too
    int brute_force_evaluations = 20;  ///< of one fit; the rest is extrapolated
    int bulk_spectra = 4000;
};

/// How far a rung's fits lie from those of the solver, which start at the lowest minimum that any rung has found.
struct BenchAccuracy {
    double median_sigmas = 0.0;  ///< of the largest difference of a parameter in each spectrum
    double worst_sigmas = 0.0;
    int other_minima = 0;  ///< left out of the two: fits that ended at a chi2 higher by 1 or more
};

/// One kind of fit on the whole work.
struct BenchRung {
    std::string name;
    std::string what;  ///< in words
    std::size_t spectra;
    Duration median;                        ///< of one fit
    double evaluations;                     ///< median of one fit
    double model_mb;                        ///< what the model keeps in memory
    std::optional<BenchAccuracy> accuracy;  ///< none for the brute force, which is not finished
};

/// Times of the same on one thread and on two, the shortest of some runs.
struct BenchThreads {
    std::string name;
    double one_s;      ///< by the clock
    double two_s;      ///< by the clock
    double one_cpu_s;  ///< processor time on one thread
};

/// All that `skinfit bench` measures.
struct BenchResult {
    BenchSizes sizes;
    std::string machine;
    std::string compiler;
    std::vector<BenchRung> rungs;  ///< brute force, paths, paths as fit_spectrum, solver, emulator
    int brute_force_timed;         ///< evaluations
    Duration brute_force_evaluation;
    std::vector<BenchThreads> threads;
    double bulk_spectra_per_s;      ///< by the clock, two threads
    double bulk_spectra_per_cpu_s;  ///< by processor time, one thread
    int bulk_not_converged;
    BenchIntervals intervals;
    double certified_error;
    Duration build;
    double recorded_rays_per_s_and_core;  ///< by processor time, one thread
    double largest_standard_error;        ///< of the recorded rays' reflectance at Table 1
    double median_standard_error;
    double peak_mb;
    Duration whole;
};

/// Told what is measured now, in words.
using BenchListener = std::function<void(const std::string&)>;

/// Measures everything in one run on the same work (`bench_work`), two threads at most.
[[nodiscard]] BenchResult measure_ladder(const BenchSizes& sizes, const BenchListener& tell);

/// The rung of that name, which there must be.
[[nodiscard]] const BenchRung& rung(const BenchResult& result, std::string_view name);

}  // namespace skinfit
