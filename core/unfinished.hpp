#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

/// What this process would leave behind if it ended now: files that are half written, and programs that it runs. All of
/// it may be called from any thread.
namespace skinfit {

/// Calls `make`, which makes the file at `path` and says whether it could; from then on the file is half written.
bool begin_file(const std::string& path, const std::function<bool()>& make);

/// Calls `end`, which removes the half-written file at `path` or puts it in its place.
void end_file(const std::string& path, const std::function<void()>& end);

/// Calls `start`, which starts a program in a process group of its own and gives its number, or 0 where that fails.
/// Returns that number.
pid_t begin_child(const std::function<pid_t()>& start);

/// Waits for a program of `begin_child` and returns its status, as `waitpid` does.
int wait_for_child(pid_t child);

/// Kills the programs that run, with those that they have started; whoever waits for them goes on.
void kill_children();

/// Ends the process with `exit_code` at once: its half-written files are removed and its programs killed.
[[noreturn]] void end_process(int exit_code);

}  // namespace skinfit
