#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace skinfit {

/// The largest file that is read into memory: 2 GiB.
inline constexpr std::size_t largest_file_bytes = std::size_t{1} << 31U;

/// The bytes of the file at `path`. Throws InputError when it is missing, unreadable, too large or no ordinary file,
/// such as a folder or a pipe; never waits for one.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Replaces the file at `path` by `bytes` in one step: it holds all of the old or all of the new, never a part.
/// Throws InputError when the folder is missing, read-only or full; then nothing has changed.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// The same for bytes in several parts and without waiting for the disk: for files that can be made again and that
/// carry a checksum.
void write_scratch_file_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts);

}  // namespace skinfit
