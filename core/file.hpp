#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skinfit {

/// The bytes of the file at `path`. Throws InputError when it is missing, a folder or unreadable.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Replaces the file at `path` by `bytes` in one step: it holds all of the old or all of the new, never a part.
/// Throws InputError when the folder is missing, read-only or full; then nothing has changed.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace skinfit
