#pragma once

#include "bench/ladder.hpp"
#include "bench/work.hpp"
#include "model/emulator.hpp"
#include "model/path_ensemble.hpp"

namespace skinfit {

/// The walks of `problem`, which has one measurement, recorded anew.
[[nodiscard]] PathEnsemble recorded(const FitProblem& problem);

/// Adds to `result` recording, responding and fitting in bulk on one thread and on two, and what follows from them.
void measure_threads(const BenchWork& work, const PathEnsemble& ensemble, const Emulator& emulator,
                     BenchResult& result);

}  // namespace skinfit
