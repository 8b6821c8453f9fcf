#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>

namespace skinfit {

/// The largest file that is read into memory: 2 GiB.
inline constexpr std::size_t largest_file_bytes = std::size_t{1} << 31U;

/// The bytes of the file at `path`. Throws InputError when it is missing, unreadable, too large or no ordinary file,
/// such as a folder or a pipe; never waits for one.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// The bytes of what a user names as an input at `path`, which is opened once: of an ordinary file, or of a pipe up to
/// its end, as the shell's `<(...)` makes one; for somebody who writes into it, it waits 5 s. `goes_on` is asked about
/// the bytes so far, again and again while there are more; where it says no, those are all. Throws InputError as
/// `read_file`, but for pipes.
[[nodiscard]] std::string read_input(const std::filesystem::path& path,
                                     const std::function<bool(std::string_view so_far)>& goes_on = {});

/// The bytes that come from standard input, up to its end. Throws InputError when it is closed or gives too many.
[[nodiscard]] std::string read_standard_input();

/// Replaces the file at `path` by `bytes` in one step: it holds all of the old or all of the new, never a part, and
/// keeps its permissions. Pipes, devices and /dev/stdout are written to. Throws InputError as FileReplacement; then
/// nothing has changed.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws InputError where `write_file_atomically` could not write now, without writing: for a check before long work.
void check_writable(const std::filesystem::path& path);

/// As `write_file_atomically`, for bytes in several parts and without waiting for the disk: for files that can be made
/// again, carry a checksum and are of use to their owner alone. Throws Cancelled where `stop` is requested meanwhile;
/// then nothing has changed either.
void write_scratch_file_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts,
                                   const std::stop_token& stop = {});

/// Makes the folder at `path`, and those above it, where there is none; removes what killed processes have left half
/// written in it. Throws InputError, naming `where`, where it is
/// then no folder that can be written.
void make_folder(const std::filesystem::path& path, const std::string& where);

}  // namespace skinfit
