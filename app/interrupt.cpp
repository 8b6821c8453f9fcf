#include "app/interrupt.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <condition_variable>

#include "app/terminal.hpp"
#include "core/unfinished.hpp"

namespace skinfit {
namespace {

constexpr int first_code_of_signals = 128;  // as shells report them

/// Wakes the watcher at the end of the program; no other use is known of it.
constexpr int wake_signal = SIGUSR2;

bool is_ignored(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

[[noreturn]] void end_at_once(int signal) {
    say_line("interrupted; what was not written yet is lost");
    end_process(first_code_of_signals + signal);
}

}  // namespace

Interrupt::Interrupt() {
    sigemptyset(&signals_);
    sigaddset(&signals_, wake_signal);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        if (!is_ignored(signal)) sigaddset(&signals_, signal);
    }
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    watcher_ = std::jthread([this] { watch(); });
}

Interrupt::~Interrupt() {
    {
        const std::scoped_lock lock(mutex_);
        over_ = true;
    }
    pthread_kill(watcher_.native_handle(), wake_signal);
}

void Interrupt::watch() {
    for (;;) {
        int signal = 0;
        if (::sigwait(&signals_, &signal) != 0) continue;
        const std::scoped_lock lock(mutex_);
        if (over_) return;
        if (signal == wake_signal) continue;
        if (!text_) end_at_once(signal);
        if (signal_ && signal == SIGXCPU) continue;  // comes again every second; the end follows from the system
        if (signal_) end_at_once(signal);
        signal_ = signal;
        stop_.request_stop();
        kill_children();
        if (!text_->empty()) say_line(*text_);
    }
}

std::stop_token Interrupt::graceful(const std::string& text) {
    const std::scoped_lock lock(mutex_);
    text_ = text;
    return stop_.get_token();
}

void Interrupt::wait() {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any stopped;
    stopped.wait(lock, stop_.get_token(), [] { return false; });
}

std::optional<int> Interrupt::signal() const {
    const std::scoped_lock lock(mutex_);
    return signal_;
}

int Interrupt::exit_code() const {
    return first_code_of_signals + signal().value();
}

}  // namespace skinfit
