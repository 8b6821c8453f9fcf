#pragma once

#include <stop_token>
#include <vector>

#include "fit/forward_model.hpp"
#include "fit/problem.hpp"
#include "model/disk_cache.hpp"

namespace skinfit {

/// What computes the light of each measurement: walks, recorded now or kept by `cache`, the angular solver, or its
/// emulator, made now or kept. Throws Cancelled soon after `stop` is requested; then nothing has been kept.
[[nodiscard]] std::vector<ForwardModel> make_models(const FitProblem& problem, Engine engine, const DiskCache& cache,
                                                    const std::stop_token& stop = {});

/// Approximations that cost a small part of `models`: a few of the recorded rays, or a coarser grid of angles; the
/// emulator is cheap itself.
[[nodiscard]] std::vector<ForwardModel> cheap_models(const FitProblem& problem,
                                                     const std::vector<ForwardModel>& models);

}  // namespace skinfit
