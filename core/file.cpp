#include "core/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/file_replacement.hpp"
#include "core/input_error.hpp"
#include "core/stop.hpp"

namespace skinfit {
namespace {

[[noreturn]] void refuse_to_read(const std::filesystem::path& path, int error) {
    throw InputError({.where = path.string(),
                      .problem = "cannot be read",
                      .why = std::strerror(error),
                      .remedy = "check the name and the permission to read it"});
}

[[noreturn]] void refuse_size(const std::filesystem::path& path) {
    throw InputError({.where = path.string(),
                      .problem = "is too large",
                      .why = "at most 2 GiB are read at once",
                      .remedy = "split it"});
}

/// An open file, closed at the end.
class Descriptor {
public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    [[nodiscard]] int get() const { return descriptor_; }

private:
    int descriptor_;
};

/// Its size, after checking that it is an ordinary file.
std::size_t ordinary_file_size(const std::filesystem::path& path, const Descriptor& descriptor) {
    struct stat status {};
    if (::fstat(descriptor.get(), &status) != 0) refuse_to_read(path, errno);
    if (S_ISDIR(status.st_mode)) {
        throw InputError({.where = path.string(),
                          .problem = "is a folder",
                          .why = "a file is needed here",
                          .remedy = "name a file inside it"});
    }
    if (!S_ISREG(status.st_mode)) {
        throw InputError({.where = path.string(),
                          .problem = "is a pipe or a device",
                          .why = "an ordinary file is needed here",
                          .remedy = "write its content to a file first"});
    }
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size > largest_file_bytes) refuse_size(path);
    return size;
}

/// Waits until there is somebody who writes into the pipe, and leaves it so that reading waits for them. Returns a byte
/// that has been read meanwhile, if any.
std::string first_byte_of_pipe(const Descriptor& descriptor, const std::filesystem::path& path) {
    constexpr int patience_ms = 5000;  // chosen: time to start a second program by hand
    pollfd waiting{.fd = descriptor.get(), .events = POLLIN, .revents = 0};
    char byte = 0;
    while (::poll(&waiting, 1, patience_ms) < 0 && errno == EINTR) {
    }
    const ssize_t count = ::read(descriptor.get(), &byte, 1);
    const bool is_silent = count < 0 && errno == EAGAIN;  // somebody has it open and has not written yet
    if (count == 0 && (waiting.revents & POLLHUP) == 0) {
        throw InputError({.where = path.string(),
                          .problem = "is a pipe into which nobody writes",
                          .why = fmt::format("{} s have been waited for it", patience_ms / 1000),
                          .remedy = "start the program that writes into it first, or name a file"});
    }
    if (count < 0 && !is_silent) refuse_to_read(path, errno);
    ::fcntl(descriptor.get(), F_SETFL, ::fcntl(descriptor.get(), F_GETFL) & ~O_NONBLOCK);
    return count == 1 ? std::string(1, byte) : std::string();
}

/// All bytes up to the end, or until `goes_on` says no, after those that are `known`; `expected` are likely. Files of
/// /proc say that they are empty, and others may grow.
std::string read_all(int descriptor, const std::filesystem::path& path, std::string known, std::size_t expected,
                     const std::function<bool(std::string_view)>& goes_on = {}) {
    constexpr std::size_t block = std::size_t{1} << 16U;
    constexpr std::size_t much = std::size_t{1} << 25U;  // memory for the whole of a file is not taken before
    std::string bytes = std::move(known);
    std::size_t filled = bytes.size();
    if (!goes_on) bytes.resize(std::max(expected, filled));
    for (;;) {
        if (filled > 0 && goes_on && !goes_on(std::string_view(bytes).substr(0, filled))) break;
        if (filled == bytes.size()) {
            bytes.resize(filled >= much ? std::max(expected, filled + filled / 2) : filled + std::max(filled, block));
        }
        const std::size_t wanted = goes_on ? std::min(block, bytes.size() - filled) : bytes.size() - filled;
        const ssize_t count = ::read(descriptor, bytes.data() + filled, wanted);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) refuse_to_read(path, errno);
        if (count == 0) break;
        filled += static_cast<std::size_t>(count);
        if (filled > largest_file_bytes) refuse_size(path);
    }
    bytes.resize(filled);
    return bytes;
}

/// True for /dev/stdout, pipes and the like, which cannot be replaced by renaming. The first few are streams even where
/// the shell has redirected them to a file: renaming would replace the name in /dev. A link to a pipe is a link.
bool is_stream(const std::filesystem::path& path) {
    const std::string name = path.lexically_normal().string();
    if (name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") || name.starts_with("/proc/")) {
        return true;
    }
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::symlink_status(path, ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status) && !std::filesystem::is_symlink(status);
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
    // Without O_NONBLOCK, opening a pipe waits for whoever writes into it.
    const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (descriptor.get() < 0) refuse_to_read(path, errno);
    return read_all(descriptor.get(), path, {}, ordinary_file_size(path, descriptor));
}

std::string read_input(const std::filesystem::path& path, const std::function<bool(std::string_view)>& goes_on) {
    // Without O_NONBLOCK, opening a pipe waits for whoever writes into it, for ever where nobody does.
    const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (descriptor.get() < 0) refuse_to_read(path, errno);
    struct stat status {};
    const bool is_pipe = ::fstat(descriptor.get(), &status) == 0 && S_ISFIFO(status.st_mode);
    if (is_pipe) return read_all(descriptor.get(), path, first_byte_of_pipe(descriptor, path), 0, goes_on);
    return read_all(descriptor.get(), path, {}, ordinary_file_size(path, descriptor), goes_on);
}

std::string read_standard_input() {
    return read_all(STDIN_FILENO, "standard input", {}, 0);
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
    if (!is_stream(path)) {
        FileReplacement file(path);
        file.append(bytes);
        file.finish();
        return;
    }
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor < 0) refuse_to_write(path, errno);
    int failure = write_all(descriptor, bytes);
    if (::close(descriptor) != 0 && failure == 0) failure = errno;
    if (failure != 0) refuse_to_write(path, failure);
}

void check_writable(const std::filesystem::path& path) {
    if (!is_stream(path)) return check_replaceable(path);
    if (::access(path.c_str(), W_OK) != 0) refuse_to_write(path, errno);
}

void make_folder(const std::filesystem::path& path, const std::string& where) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!error && std::filesystem::is_directory(path, error) && ::access(path.c_str(), W_OK) == 0) {
        remove_leftovers(path);
        return;
    }
    throw InputError({.where = where,
                      .problem = "no folder that can be written",
                      .why = error ? error.message() : "it is a file or not ours to write",
                      .remedy = "name another folder"});
}

void write_scratch_file_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts,
                                   const std::stop_token& stop) {
    constexpr std::size_t chunk_bytes = std::size_t{1} << 24U;  // written within some hundredths of a second
    FileReplacement file(path, Readers::owner_only);
    for (const std::string_view part : parts) {
        for (std::size_t begin = 0; begin < part.size(); begin += chunk_bytes) {
            leave_if_cancelled(stop);
            file.append(part.substr(begin, chunk_bytes));
        }
    }
    file.finish(false);
}

}  // namespace skinfit
