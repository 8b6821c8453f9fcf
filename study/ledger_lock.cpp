#include "study/ledger_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include "core/file_replacement.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace {

constexpr std::string_view mark = "skinfit lock: ";
constexpr std::size_t lock_bytes = 200;  // always, so that one write replaces all of it

/// What a lock of this process holds.
std::string own_text() {
    std::array<char, 100> host{};
    (void)::gethostname(host.data(), host.size() - 1);
    std::string text = fmt::format("{}process {} on {}", mark, ::getpid(), host.data());
    text.resize(lock_bytes - 1, ' ');
    return text + "\n";
}

std::string text_in(int descriptor) {
    std::string text(lock_bytes + 1, '\0');
    const ssize_t count = ::pread(descriptor, text.data(), text.size(), 0);
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
}

/// Locks of release 0.1.0 have no mark: "process 12 on host".
bool is_lock_text(const std::string& text) {
    if (text.starts_with(mark)) return text.size() == lock_bytes;
    constexpr std::string_view process = "process ";
    const std::size_t on = text.find(" on ");
    return text.starts_with(process) && on != std::string::npos && text.find('\n') == std::string::npos &&
           parse_count(std::string_view(text).substr(process.size(), on - process.size())).has_value();
}

/// Opens what is there, unless it is something else than a lock.
int opened_lock(const std::filesystem::path& file) {
    refuse_link(file);
    const int descriptor = ::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) refuse_to_write(file, errno);
    struct stat status {};
    const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    if (is_file && is_lock_text(text_in(descriptor))) return descriptor;
    ::close(descriptor);
    throw InputError({.where = file.string(),
                      .problem = "is no lock of a ledger",
                      .why = "it is another program's, or damaged, and is left as it is",
                      .remedy = "name another ledger or output folder, or move this file away"});
}

}  // namespace

LedgerLock::LedgerLock(const std::filesystem::path& ledger) {
    const std::filesystem::path file = ledger.string() + ".lock";
    make_file_if_missing(file, own_text());
    descriptor_ = opened_lock(file);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        const bool is_held = errno == EWOULDBLOCK;
        const std::string problem = std::strerror(errno);
        const std::string text = text_in(descriptor_);
        ::close(descriptor_);
        const std::string_view holder =
            trimmed(std::string_view(text).substr(text.starts_with(mark) ? mark.size() : 0));
        throw InputError({.where = ledger.string(),
                          .problem = "is in use",
                          .why = is_held ? fmt::format("{} runs this study", holder) : problem,
                          .remedy = "wait for it, or stop it; `skinfit study status` shows how far it is"});
    }
    const std::string me = own_text();
    (void)!::pwrite(descriptor_, me.data(), me.size(), 0);
}

LedgerLock::LedgerLock(LedgerLock&& other) noexcept : descriptor_(other.descriptor_) {
    other.descriptor_ = -1;
}

LedgerLock::~LedgerLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace skinfit
