#include "core/file_replacement.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "core/input_error.hpp"
#include "core/unfinished.hpp"

namespace skinfit {
namespace {

constexpr std::string_view partial_prefix = ".skinfit-";
constexpr std::string_view partial_suffix = ".part";
constexpr std::size_t partial_digits = 16;
constexpr mode_t permissions = 0777;
constexpr mode_t of_the_group = 0070;

[[noreturn]] void refuse_kind(const std::filesystem::path& path, const std::string& why) {
    throw InputError({.where = path.string(),
                      .problem = "cannot be written",
                      .why = why,
                      .remedy = "name another file, or move this one away"});
}

/// What the file that is to be replaced is, or nothing where there is none.
std::optional<struct stat> replaced_file(const std::filesystem::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
        if (errno == ENOENT) return std::nullopt;
        refuse_to_write(path, errno);
    }
    refuse_link(path);
    if (S_ISDIR(status.st_mode)) refuse_to_write(path, EISDIR);
    if (!S_ISREG(status.st_mode)) refuse_kind(path, "it is a pipe or a device");
    if (::access(path.c_str(), W_OK) != 0) refuse_to_write(path, errno);
    return status;
}

std::string partial_name(const std::filesystem::path& path) {
    std::uint64_t number = 0;
    if (::getrandom(&number, sizeof number, 0) != sizeof number) refuse_to_write(path, errno);
    return (path.parent_path() / fmt::format("{}{:016x}{}", partial_prefix, number, partial_suffix)).string();
}

/// A new file beside `path` that nobody else has, locked; sets `name`.
int make_partial(const std::filesystem::path& path, mode_t mode, std::string& name) {
    for (;;) {
        name = partial_name(path);
        int descriptor = -1;
        const bool is_made = begin_file(name, [&] {
            descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
            return descriptor >= 0;
        });
        if (!is_made && errno == EEXIST) continue;
        if (!is_made) refuse_to_write(path, errno);
        // A file system without locks leaves leftovers alone.
        (void)::flock(descriptor, LOCK_EX | LOCK_NB);
        struct stat status {};
        if (::fstat(descriptor, &status) == 0 && status.st_nlink > 0) return descriptor;
        // Another process has taken it for a leftover before it was locked.
        ::close(descriptor);
        end_file(name, [] {});
    }
}

/// Gives the new file the permissions of the one that it replaces, and its owner and group where that is allowed.
void take_over(int descriptor, const struct stat& replaced) {
    struct stat made {};
    if (::fstat(descriptor, &made) != 0) return;
    constexpr uid_t unchanged_user = static_cast<uid_t>(-1);
    constexpr gid_t unchanged_group = static_cast<gid_t>(-1);
    const bool same_group =
        made.st_gid == replaced.st_gid || ::fchown(descriptor, unchanged_user, replaced.st_gid) == 0;
    if (made.st_uid != replaced.st_uid) (void)!::fchown(descriptor, replaced.st_uid, unchanged_group);
    const mode_t mode = replaced.st_mode & permissions;
    // What one group was allowed is not for another.
    (void)!::fchmod(descriptor, same_group ? mode : mode & ~of_the_group);
}

}  // namespace

void refuse_to_write(const std::filesystem::path& path, int error) {
    throw InputError({.where = path.string(),
                      .problem = "cannot be written",
                      .why = std::strerror(error),
                      .remedy = "name a file in a folder that exists, is writable and has space"});
}

void refuse_link(const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::is_symlink(path, none)) return;
    refuse_kind(path, "it is a link, and links are neither followed nor replaced");
}

int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

FileReplacement::FileReplacement(std::filesystem::path path, Readers readers) : path_(std::move(path)) {
    constexpr mode_t ordinary_file = 0666;
    constexpr mode_t private_file = 0600;
    const std::optional<struct stat> replaced = replaced_file(path_);
    const bool is_ordinary = readers == Readers::by_mask && !replaced;
    descriptor_ = make_partial(path_, is_ordinary ? ordinary_file : private_file, temporary_);
    if (readers == Readers::by_mask && replaced) take_over(descriptor_, *replaced);
}

FileReplacement::~FileReplacement() {
    if (!temporary_.empty()) end_file(temporary_, [this] { ::unlink(temporary_.c_str()); });
    if (descriptor_ >= 0) ::close(descriptor_);
}

void FileReplacement::append(std::string_view bytes) {
    if (const int failure = write_all(descriptor_, bytes)) refuse_to_write(path_, failure);
}

void FileReplacement::finish(bool durable) {
    if (durable && ::fsync(descriptor_) != 0) refuse_to_write(path_, errno);
    // Some file systems complain at closing only. The lock goes with the last descriptor, after the renaming.
    const int copy = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
    if (copy < 0 || ::close(copy) != 0) refuse_to_write(path_, errno);
    int failure = 0;
    end_file(temporary_, [&] {
        if (std::rename(temporary_.c_str(), path_.c_str()) == 0) return;
        failure = errno;
        ::unlink(temporary_.c_str());
    });
    temporary_.clear();
    ::close(std::exchange(descriptor_, -1));
    if (failure != 0) refuse_to_write(path_, failure);
}

void make_file_if_missing(const std::filesystem::path& path, std::string_view bytes) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) == 0) return;
    constexpr mode_t ordinary_file = 0666;
    std::string temporary;
    const int descriptor = make_partial(path, ordinary_file, temporary);
    int failure = write_all(descriptor, bytes);
    if (failure == 0 && ::link(temporary.c_str(), path.c_str()) != 0 && errno != EEXIST) failure = errno;
    end_file(temporary, [&] { ::unlink(temporary.c_str()); });
    ::close(descriptor);
    if (failure != 0) refuse_to_write(path, failure);
}

void check_replaceable(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    remove_leftovers(folder.empty() ? "." : folder);
    const FileReplacement probe(path);
}

bool is_partial(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    if (name.size() != partial_prefix.size() + partial_digits + partial_suffix.size()) return false;
    if (!name.starts_with(partial_prefix) || !name.ends_with(partial_suffix)) return false;
    const std::string_view digits = std::string_view(name).substr(partial_prefix.size(), partial_digits);
    return digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool remove_leftover(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return false;
    struct stat status {};
    const bool is_left = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1 &&
                         status.st_uid == ::geteuid() && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    const bool is_gone = is_left && ::unlink(path.c_str()) == 0;
    ::close(descriptor);
    return is_gone;
}

void remove_leftovers(const std::filesystem::path& folder) {
    std::error_code error;
    for (auto at = std::filesystem::directory_iterator(folder, error); !error && at != end(at); at.increment(error)) {
        if (is_partial(at->path())) remove_leftover(at->path());
    }
}

}  // namespace skinfit
