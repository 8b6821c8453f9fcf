#include "core/unfinished.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <mutex>
#include <set>

namespace skinfit {
namespace {

struct Unfinished {
    std::mutex mutex;
    std::set<std::string> files;
    std::set<pid_t> children;
};

/// Never destroyed: threads may still write while the program ends.
Unfinished& unfinished() {
    static auto* const all = new Unfinished;
    return *all;
}

/// The lock must be held.
void kill_all(const std::set<pid_t>& children) {
    for (const pid_t child : children) ::kill(-child, SIGKILL);
}

}  // namespace

bool begin_file(const std::string& path, const std::function<bool()>& make) {
    const std::scoped_lock lock(unfinished().mutex);
    if (!make()) return false;
    unfinished().files.insert(path);
    return true;
}

void end_file(const std::string& path, const std::function<void()>& end) {
    const std::scoped_lock lock(unfinished().mutex);
    end();
    unfinished().files.erase(path);
}

pid_t begin_child(const std::function<pid_t()>& start) {
    const std::scoped_lock lock(unfinished().mutex);
    const pid_t child = start();
    if (child > 0) unfinished().children.insert(child);
    return child;
}

int wait_for_child(pid_t child) {
    // Until it is reaped its number belongs to no other.
    ::siginfo_t ended{};
    while (::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
    }
    const std::scoped_lock lock(unfinished().mutex);
    unfinished().children.erase(child);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

void kill_children() {
    const std::scoped_lock lock(unfinished().mutex);
    kill_all(unfinished().children);
}

void end_process(int exit_code) {
    // Held for ever: nothing may begin any more.
    unfinished().mutex.lock();
    for (const std::string& file : unfinished().files) ::unlink(file.c_str());
    kill_all(unfinished().children);
    ::_exit(exit_code);
}

}  // namespace skinfit
