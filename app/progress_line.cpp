#include "app/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace skinfit {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
}

/// "1 h 02 min", "3 min 05 s" or "12 s".
std::string duration_text(double seconds) {
    const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
    constexpr std::uint64_t minute = 60;
    constexpr std::uint64_t hour = 60 * minute;
    if (whole >= hour) return fmt::format("{} h {:02} min", whole / hour, whole % hour / minute);
    if (whole >= minute) return fmt::format("{} min {:02} s", whole / minute, whole % minute);
    return fmt::format("{} s", whole);
}

std::string bar_text(double share) {
    constexpr int width = 24;
    const int filled = static_cast<int>(share * width);
    return "[" + std::string(static_cast<std::size_t>(filled), '#') +
           std::string(static_cast<std::size_t>(width - filled), '.') + "]";
}

}  // namespace

ProgressLine::ProgressLine(const Options& options)
    : options_(options), terminal_(::isatty(STDERR_FILENO) != 0), begin_(Clock::now()), shown_(begin_) {}

ProgressLine::~ProgressLine() {
    if (open_) fmt::print(stderr, "\n");
}

void ProgressLine::show(const Progress& progress) {
    last_ = progress;
    if (options_.quiet) return;
    if (progress.count == 0) begin_ = Clock::now();
    const double wait = terminal_ ? 0.1 : (options_.verbose ? 1.0 : 10.0);
    if (seconds_since(shown_) < wait) return;
    print(progress);
}

void ProgressLine::print(const Progress& progress) {
    shown_ = Clock::now();
    const double share =
        progress.total == 0 ? 1.0 : static_cast<double>(progress.done) / static_cast<double>(progress.total);
    const double elapsed = seconds_since(begin_);
    std::string text = progress.what;
    if (progress.count > 0 && elapsed > 0.0) {
        text += fmt::format(", {:.3g} {}/s", static_cast<double>(progress.count) / elapsed, progress.unit);
    }
    if (share > 0.0 && share < 1.0) text += ", " + duration_text(elapsed / share * (1.0 - share)) + " left";
    if (terminal_) {
        constexpr const char* clear_line = "\r\x1b[K";
        fmt::print(stderr, "{}{} {}", clear_line, bar_text(share), text);
        std::fflush(stderr);
        open_ = true;
    } else {
        fmt::print(stderr, "{}\n", text);
    }
    printed_ = true;
}

void ProgressLine::tell(const std::string& text) {
    if (options_.quiet) return;
    if (open_) fmt::print(stderr, "\n");
    open_ = false;
    fmt::print(stderr, "{}\n", text);
}

void ProgressLine::end() {
    if (options_.quiet) return;
    if (printed_ || options_.verbose) print(last_);
    if (open_) fmt::print(stderr, "\n");
    open_ = false;
}

}  // namespace skinfit
