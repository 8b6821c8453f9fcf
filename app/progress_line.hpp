#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace skinfit {

/// How far something is.
struct Progress {
    std::uint64_t done;  ///< of `total`, in units of equal cost
    std::uint64_t total;
    std::string what;     ///< in words
    std::uint64_t count;  ///< things done, for the rate
    std::string unit;     ///< of `count`
};

/// Shows on stderr how far a long command is: on a terminal a bar that is drawn again and again, elsewhere a line now
/// and then.
class ProgressLine {
public:
    struct Options {
        bool quiet = false;
        bool verbose = false;  ///< lines every second rather than every 10 s
    };

    explicit ProgressLine(const Options& options);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    /// Ends the line.
    ~ProgressLine();

    void show(const Progress& progress);
    /// Prints a line of its own.
    void tell(const std::string& text);
    /// Shows the last state and ends the line.
    void end();

private:
    void print(const Progress& progress);

    Options options_;
    bool terminal_;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point shown_;
    Progress last_{};
    bool open_ = false;  ///< a bar stands on the current line
    bool printed_ = false;
};

}  // namespace skinfit
