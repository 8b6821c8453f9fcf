#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/path_ensemble.hpp"

namespace skinfit {

/// Ensembles kept on disk between runs, in one folder, at most `limit_bytes` of them: the longest unused go first.
struct EnsembleCache {
    std::optional<std::filesystem::path> folder;     ///< none: nothing is kept
    std::function<void(const std::string&)> warn;    ///< told, once a file, of what is wrong with the cache
    std::function<void(const std::string&)> inform;  ///< told before a recording starts
    std::uint64_t limit_bytes = std::uint64_t{2} << 30U;
};

/// Everything that decides what is recorded, as text: sample, wavelengths, rays, seed, and the hash of a few rays.
[[nodiscard]] std::string ensemble_key(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                       const WalkOptions& options);

/// The ensemble from the cache, or traced anew and then kept. A file that is damaged, truncated or foreign is reported
/// to `cache.warn` and replaced; a folder that cannot be written is reported and does no harm. Throws InputError for a
/// recording that needs more than 70 % of the machine's memory.
[[nodiscard]] PathEnsemble cached_ensemble(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                           const WalkOptions& options, const EnsembleCache& cache);

/// $SKINFIT_CACHE_DIR, else $XDG_CACHE_HOME/skinfit, else $HOME/.cache/skinfit; none where all are unset.
[[nodiscard]] std::optional<std::filesystem::path> default_cache_folder();

}  // namespace skinfit
