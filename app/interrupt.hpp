#pragma once

#include <csignal>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace skinfit {

/// What Ctrl-C and its like do (SIGINT, SIGTERM, SIGHUP and SIGXCPU, the end of a limit on processor time; those that
/// the caller ignores stay ignored). A command ends at once and leaves no half-written file, unless it has asked to be
/// told.
class Interrupt {
public:
    /// Keeps the signals from this thread and from all that start later, and waits for them in a thread of its own.
    Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;
    ~Interrupt();

    /// From now on the first signal prints `text`, if any, requests a stop of the token and kills the programs that
    /// this one runs (gnuplot); the second ends the program at once.
    [[nodiscard]] std::stop_token graceful(const std::string& text);

    /// Waits for a stop of the token of `graceful`.
    void wait();

    /// The signal that has come, if one has.
    [[nodiscard]] std::optional<int> signal() const;

    /// The exit code of a command that ended before its end: 128 plus the signal's number. Call only after a signal.
    [[nodiscard]] int exit_code() const;

private:
    void watch();

    sigset_t signals_{};
    mutable std::mutex mutex_;
    std::optional<std::string> text_;  ///< set: graceful
    std::optional<int> signal_;
    bool over_ = false;
    std::stop_source stop_;
    std::jthread watcher_;
};

}  // namespace skinfit
