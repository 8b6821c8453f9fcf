#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace skinfit {

/// What is to be done, and what came of it, as bytes: they may travel to other processes.
using Worker = std::function<std::string(const std::string& task)>;

/// A task that is done.
struct DoneTask {
    std::size_t number;
    std::string result;
};

/// Threads that do tasks one by one.
class WorkerThreads {
public:
    /// `work` is called from all `threads`; an exception of it ends the program, since only bugs throw there.
    WorkerThreads(int threads, Worker work);
    WorkerThreads(const WorkerThreads&) = delete;
    WorkerThreads& operator=(const WorkerThreads&) = delete;
    /// Waits for the tasks that have begun and drops the others.
    ~WorkerThreads();

    void give(std::size_t number, std::string task);
    /// A task that is done, waiting at most so long for one.
    [[nodiscard]] std::optional<DoneTask> take(std::chrono::milliseconds patience);
    /// Tasks given and not taken.
    [[nodiscard]] std::size_t outstanding() const { return outstanding_; }
    /// The number of tasks that keeps all threads busy between two looks at them.
    [[nodiscard]] std::size_t capacity() const { return threads_.size() + 1; }

private:
    void work_off(const std::stop_token& stop);

    Worker work_;
    std::mutex mutex_;
    std::condition_variable_any given_;
    std::condition_variable done_;
    std::deque<std::pair<std::size_t, std::string>> tasks_;
    std::deque<DoneTask> results_;
    std::size_t outstanding_ = 0;
    std::vector<std::jthread> threads_;
};

/// Other processes, each with worker threads, that ask for tasks.
struct RemoteWorkers {
    /// What has arrived: results, which also stand for requests of their workers.
    std::function<std::vector<DoneTask>()> receive;
    /// Gives a task to a process that waits; false where none does.
    std::function<bool(std::size_t number, const std::string& task)> give;
};

/// How tasks are led.
struct Leading {
    std::size_t tasks;                                    ///< numbered from 0
    std::function<std::string(std::size_t number)> text;  ///< of a task
    std::function<void(const DoneTask&)> take;            ///< called once for each, by the caller's thread
    std::function<bool()> stop;                           ///< no further task is given once it is true
};

/// Has all tasks done by `threads`, and by `remote` workers where there are any; the order is that in which they are
/// ready. Returns how many have been done: all, but for those not given after a stop. What `take` throws ends it.
std::size_t lead(WorkerThreads& threads, const Leading& leading, const RemoteWorkers* remote);

}  // namespace skinfit
