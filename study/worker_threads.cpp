#include "study/worker_threads.hpp"

#include <utility>

namespace skinfit {

WorkerThreads::WorkerThreads(int threads, Worker work) : work_(std::move(work)) {
    for (int i = 0; i < threads; ++i) {
        threads_.emplace_back([this](const std::stop_token& stop) { work_off(stop); });
    }
}

WorkerThreads::~WorkerThreads() {
    for (std::jthread& thread : threads_) thread.request_stop();
}

void WorkerThreads::work_off(const std::stop_token& stop) {
    while (true) {
        std::pair<std::size_t, std::string> task;
        {
            std::unique_lock lock(mutex_);
            if (!given_.wait(lock, stop, [this] { return !tasks_.empty(); }) || stop.stop_requested()) return;
            task = std::move(tasks_.front());
            tasks_.pop_front();
        }
        std::string result = work_(task.second);
        {
            const std::lock_guard lock(mutex_);
            results_.push_back({.number = task.first, .result = std::move(result)});
        }
        done_.notify_one();
    }
}

void WorkerThreads::give(std::size_t number, std::string task) {
    {
        const std::lock_guard lock(mutex_);
        tasks_.emplace_back(number, std::move(task));
    }
    ++outstanding_;
    given_.notify_one();
}

std::optional<DoneTask> WorkerThreads::take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    if (!done_.wait_for(lock, patience, [this] { return !results_.empty(); })) return std::nullopt;
    DoneTask done = std::move(results_.front());
    results_.pop_front();
    --outstanding_;
    return done;
}

std::size_t lead(WorkerThreads& threads, const Leading& leading, const RemoteWorkers* remote) {
    using std::chrono_literals::operator""ms;
    std::size_t next = 0;
    std::size_t done = 0;
    const auto take = [&](const DoneTask& task) {
        leading.take(task);
        ++done;
    };
    while (true) {
        const bool more = next < leading.tasks && !leading.stop();
        if (!more && done == next) return done;
        if (more && threads.outstanding() < threads.capacity()) {
            threads.give(next, leading.text(next));
            ++next;
            continue;
        }
        if (remote != nullptr) {
            for (const DoneTask& task : remote->receive()) take(task);
            if (more && remote->give(next, leading.text(next))) {
                ++next;
                continue;
            }
        }
        if (const std::optional<DoneTask> task = threads.take(remote == nullptr ? 50ms : 1ms)) take(*task);
    }
}

}  // namespace skinfit
