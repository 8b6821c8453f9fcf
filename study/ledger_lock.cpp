#include "study/ledger_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

/// Who holds the lock, as it wrote there.
std::string holder_of(int descriptor) {
    std::array<char, 200> text{};
    const ssize_t count = ::pread(descriptor, text.data(), text.size(), 0);
    return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "another process";
}

std::string this_process() {
    std::array<char, 100> host{};
    (void)::gethostname(host.data(), host.size() - 1);
    return fmt::format("process {} on {}", ::getpid(), host.data());
}

}  // namespace

LedgerLock::LedgerLock(const std::filesystem::path& ledger) {
    const std::string file = ledger.string() + ".lock";
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0) {
        throw InputError({.where = file,
                          .problem = "cannot be written",
                          .why = std::strerror(errno),
                          .remedy = "name an output folder that exists and is writable"});
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        const std::string why =
            errno == EWOULDBLOCK ? holder_of(descriptor_) + " runs this study" : std::string(std::strerror(errno));
        ::close(descriptor_);
        throw InputError({.where = ledger.string(),
                          .problem = "is in use",
                          .why = why,
                          .remedy = "wait for it, or stop it; `skinfit study status` shows how far it is"});
    }
    const std::string me = this_process();
    if (::ftruncate(descriptor_, 0) == 0) (void)!::pwrite(descriptor_, me.data(), me.size(), 0);
}

LedgerLock::LedgerLock(LedgerLock&& other) noexcept : descriptor_(other.descriptor_) {
    other.descriptor_ = -1;
}

LedgerLock::~LedgerLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace skinfit
