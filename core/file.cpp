#include "core/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

[[noreturn]] void refuse_to_write(const std::filesystem::path& path, int error) {
    throw InputError({.where = path.string(),
                      .problem = "cannot be written",
                      .why = std::strerror(error),
                      .remedy = "name a file in a folder that exists, is writable and has space; nothing was written"});
}

/// Writes all bytes and flushes them to the disk; returns 0 or the errno of what failed.
int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::fsync(descriptor) == 0 ? 0 : errno;
}

/// True for /dev/stdout, pipes and the like, which cannot be replaced by renaming. The first few are streams even where
/// the shell has redirected them to a file: renaming would replace the name in /dev.
bool is_stream(const std::filesystem::path& path) {
    const std::string name = path.lexically_normal().string();
    if (name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") || name.starts_with("/proc/")) {
        return true;
    }
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(path, ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status);
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw InputError({.where = path.string(),
                          .problem = "is a folder",
                          .why = "a file is needed here",
                          .remedy = "name a file inside it"});
    }
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (!stream.is_open() || stream.bad()) {
        throw InputError({.where = path.string(),
                          .problem = "cannot be read",
                          .why = std::strerror(errno),
                          .remedy = "check the name and the permission to read it"});
    }
    return bytes;
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
    if (is_stream(path)) {
        const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND);
        if (descriptor < 0) refuse_to_write(path, errno);
        const int failure = write_all(descriptor, bytes);
        ::close(descriptor);
        if (failure != 0 && failure != EINVAL && failure != EROFS) refuse_to_write(path, failure);  // no fsync on pipes
        return;
    }
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse_to_write(path, EISDIR);
    std::string temporary = path.string() + ".XXXXXX";
    const int descriptor = ::mkstemp(temporary.data());
    if (descriptor < 0) refuse_to_write(path, errno);
    constexpr mode_t ordinary_file = 0666;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(descriptor, ordinary_file & ~mask);
    int failure = write_all(descriptor, bytes);
    if (::close(descriptor) != 0 && failure == 0) failure = errno;
    if (failure == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) failure = errno;
    if (failure != 0) {
        ::unlink(temporary.c_str());
        refuse_to_write(path, failure);
    }
}

}  // namespace skinfit
