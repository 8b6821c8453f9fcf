#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>

#include "model/disk_cache.hpp"
#include "model/emulator.hpp"

namespace skinfit {

/// Everything that decides what an emulator is, as text: its domain, and the hash of the running program, so that what
/// another version of the program has kept is never mistaken for this one's.
[[nodiscard]] std::string emulator_key(const EmulatorDomain& domain);

/// As `write_stored_file` and `read_stored_file`.
void write_emulator_file(const std::filesystem::path& path, std::string_view key, const Emulator& emulator,
                         const std::stop_token& stop = {});
[[nodiscard]] std::variant<Emulator, Unusable> read_emulator_file(const std::filesystem::path& path,
                                                                  std::string_view key);

/// The emulator from the cache, or built anew and then kept. Throws Cancelled as `Emulator::build`; then nothing has
/// been kept.
[[nodiscard]] Emulator cached_emulator(const EmulatorDomain& domain, const DiskCache& cache,
                                       const std::stop_token& stop = {});

}  // namespace skinfit
