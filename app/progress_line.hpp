#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "app/session.hpp"

namespace skinfit {

/// How far something is.
struct Progress {
    std::string what;         ///< in words
    std::uint64_t done = 0;   ///< of `total`, in units of equal cost; 0 when a stage begins
    std::uint64_t total = 0;  ///< 0: nobody knows
    std::uint64_t count = 0;  ///< things done, for the rate; 0: none is shown
    std::string unit{};       ///< of `count`
};

/// Shows on stderr how far a command is, where that is a terminal and the command takes longer than a second: a bar,
/// drawn again and again. Not with --quiet. Any thread may call its functions.
class ProgressLine {
public:
    /// What is written where stderr is no terminal, as in the log of a batch job.
    enum class Log {
        none,
        now_and_then,  ///< a line every 10 s
        often,         ///< every second, and at the end
    };

    /// `what` is being done, in words.
    ProgressLine(const Session& session, const std::string& what, Log log = Log::none);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    /// As `end`.
    ~ProgressLine();

    /// Shows how far it is, if it is time to.
    void show(const Progress& progress);
    /// Prints a line of its own.
    void tell(const std::string& text);
    /// The same with "warning: " before it.
    void warn(const std::string& text);
    /// Takes the bar away: before the command prints its result.
    void end();

private:
    using Clock = std::chrono::steady_clock;

    void draw_now_and_then(const std::stop_token& stop);
    void draw();
    void log();

    bool quiet_;
    bool terminal_;
    Log log_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    Progress now_;
    Clock::time_point stage_begin_;
    Clock::time_point logged_;
    bool is_drawn_ = false;  ///< a bar stands on the current line
    bool has_logged_ = false;
    bool over_ = false;
    std::jthread drawer_;
};

}  // namespace skinfit
