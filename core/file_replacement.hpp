#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Every file that this program makes, but for the database of a ledger, is made here: under another name in the same
/// folder, `.skinfit-0123456789abcdef.part`, and put in its place in one step. No link is followed or replaced. What a
/// process that was killed has left of such a file is known by that name, its owner and the lock that nobody holds.
namespace skinfit {

/// Who may read a new file; one that replaces another keeps the permissions of that.
enum class Readers {
    by_mask,    ///< whom the user's mask (umask) lets
    owner_only  ///< nobody else, whatever stood in its place
};

/// A file that is written in parts and then, in one step, takes the place of the one at its path. Until it does, or if
/// it never does, the old one is untouched.
class FileReplacement {
public:
    /// Throws InputError when the folder is missing or read-only, or `path` is a link, a folder, a pipe, a device or a
    /// file that must not be written.
    explicit FileReplacement(std::filesystem::path path, Readers readers = Readers::by_mask);
    FileReplacement(const FileReplacement&) = delete;
    FileReplacement& operator=(const FileReplacement&) = delete;
    /// Removes what was written where `finish` has not been called.
    ~FileReplacement();

    /// Throws InputError when the disk is full.
    void append(std::string_view bytes);

    /// Puts the file in its place, once; `durable` waits until the disk has it. Throws InputError when that fails.
    void finish(bool durable = true);

private:
    std::filesystem::path path_;
    std::string temporary_;  ///< its name; empty once it is in its place
    int descriptor_ = -1;
};

/// Makes the file at `path`, which then holds `bytes`, unless something has that name: never a part of them, never in
/// place of another. Throws InputError where there is no such name and it cannot be made.
void make_file_if_missing(const std::filesystem::path& path, std::string_view bytes);

/// Throws InputError where no file could be made at `path`, or replaced, now; removes what killed processes have left
/// in its folder. For a check before long work.
void check_replaceable(const std::filesystem::path& path);

/// Whether a file of this name is one that is being written, or what is left of one.
[[nodiscard]] bool is_partial(const std::filesystem::path& path);

/// Removes the half-written file at `path` where it belongs to this user and no process holds it; says whether it is
/// gone.
bool remove_leftover(const std::filesystem::path& path);

/// Removes those of a folder.
void remove_leftovers(const std::filesystem::path& folder);

/// Throws InputError where `path` is a link.
void refuse_link(const std::filesystem::path& path);

/// Throws the InputError that says that `path` cannot be written, by an errno.
[[noreturn]] void refuse_to_write(const std::filesystem::path& path, int error);

/// Writes all of `bytes` to an open file; returns 0 or the errno of what failed.
[[nodiscard]] int write_all(int descriptor, std::string_view bytes);

}  // namespace skinfit
