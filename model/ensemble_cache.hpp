#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "model/disk_cache.hpp"
#include "model/path_ensemble.hpp"

namespace skinfit {

/// Everything that decides what is recorded, as text: sample, wavelengths, rays, seed, and the hash of a few rays.
[[nodiscard]] std::string ensemble_key(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                       const WalkOptions& options);

/// The ensemble from the cache, or traced anew and then kept. A file that is damaged, truncated or foreign is reported
/// to `cache.warn` and replaced; a folder that cannot be written is reported and does no harm. Throws InputError for a
/// recording that needs more than 70 % of the machine's memory, and Cancelled as `PathEnsemble::trace`; then nothing
/// has been kept.
[[nodiscard]] PathEnsemble cached_ensemble(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                           const WalkOptions& options, const DiskCache& cache,
                                           const std::stop_token& stop = {});

}  // namespace skinfit
