#include "app/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "app/terminal.hpp"
#include "core/utf8.hpp"

namespace skinfit {
namespace {

using namespace std::chrono_literals;

constexpr auto patience = 1s;  // what ends sooner shows no bar

double seconds_since(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
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

double share_of(const Progress& progress) {
    if (progress.total == 0) return 0.0;
    return std::min(1.0, static_cast<double>(progress.done) / static_cast<double>(progress.total));
}

std::string bar_text(const Progress& progress) {
    constexpr std::size_t width = 24;
    if (progress.total == 0) return "";
    const auto filled = static_cast<std::size_t>(share_of(progress) * width);
    return "[" + std::string(filled, '#') + std::string(width - filled, '.') + "] ";
}

std::string in_words(const Progress& progress, double elapsed_s) {
    std::string text = printable(progress.what);
    if (progress.count > 0 && elapsed_s > 0.0) {
        text += fmt::format(", {:.3g} {}/s", static_cast<double>(progress.count) / elapsed_s, progress.unit);
    }
    const double share = share_of(progress);
    if (share == 0.0) return text + ", " + duration_text(elapsed_s);
    if (share < 1.0) text += ", " + duration_text(elapsed_s / share * (1.0 - share)) + " left";
    return text;
}

}  // namespace

ProgressLine::ProgressLine(const Session& session, const std::string& what, Log log)
    : quiet_(session.quiet),
      terminal_(is_terminal(STDERR_FILENO)),
      log_(log),
      now_{.what = what},
      stage_begin_(Clock::now()),
      logged_(stage_begin_) {
    if (terminal_ && !quiet_) drawer_ = std::jthread([this](const std::stop_token& stop) { draw_now_and_then(stop); });
}

ProgressLine::~ProgressLine() {
    end();
}

void ProgressLine::draw_now_and_then(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    auto pause = std::chrono::milliseconds(patience);
    while (!wake_.wait_for(lock, stop, pause, [&stop] { return stop.stop_requested(); })) {
        draw();
        pause = 100ms;
    }
}

void ProgressLine::draw() {
    write_stderr(fmt::format("{}{}{}", clear_line, bar_text(now_), in_words(now_, seconds_since(stage_begin_))));
    is_drawn_ = true;
}

void ProgressLine::log() {
    logged_ = Clock::now();
    has_logged_ = true;
    write_stderr(fmt::format("{}\n", in_words(now_, seconds_since(stage_begin_))));
}

void ProgressLine::show(const Progress& progress) {
    const std::scoped_lock lock(mutex_);
    if (progress.done == 0) stage_begin_ = Clock::now();
    now_ = progress;
    const double wait_s = log_ == Log::often ? 1.0 : 10.0;
    if (!quiet_ && !terminal_ && log_ != Log::none && seconds_since(logged_) >= wait_s) log();
}

void ProgressLine::tell(const std::string& text) {
    const std::scoped_lock lock(mutex_);
    if (!quiet_) say_line(text);
}

void ProgressLine::warn(const std::string& text) {
    const std::scoped_lock lock(mutex_);
    if (!quiet_) say_trouble("warning", text);
}

void ProgressLine::end() {
    if (drawer_.joinable()) {
        drawer_.request_stop();
        drawer_.join();
    }
    if (quiet_ || std::exchange(over_, true)) return;
    if (is_drawn_) write_stderr(clear_line);
    if (!terminal_ && (has_logged_ || log_ == Log::often)) log();
}

}  // namespace skinfit
