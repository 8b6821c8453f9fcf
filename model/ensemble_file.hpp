#pragma once

#include <filesystem>
#include <string_view>
#include <variant>

#include "model/path_ensemble.hpp"
#include "model/stored_file.hpp"

namespace skinfit {

/// Stores `ensemble` under `key` in the file at `path`, with a checksum over all of it. Throws InputError where the
/// file cannot be written; then nothing has changed.
void write_ensemble_file(const std::filesystem::path& path, std::string_view key, const PathEnsemble& ensemble,
                         const std::stop_token& stop = {});

/// The ensemble stored under `key` in the file at `path`, mapped into memory; or why it cannot be used: foreign,
/// truncated, damaged or of another key. `path` must exist.
[[nodiscard]] std::variant<PathEnsemble, Unusable> read_ensemble_file(const std::filesystem::path& path,
                                                                      std::string_view key);

}  // namespace skinfit
