#include "study/worker_threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>

namespace skinfit {
namespace {

std::string doubled(const std::string& task) {
    return task + task;
}

/// What became of tasks.
struct Taken {
    std::vector<int> times;
    std::vector<std::size_t> order;

    explicit Taken(std::size_t tasks) : times(tasks, 0) {}
    [[nodiscard]] Leading leading(std::function<bool()> stop = [] { return false; }) {
        return {.tasks = times.size(),
                .text = [](std::size_t number) { return std::to_string(number); },
                .take =
                    [this](const DoneTask& task) {
                        EXPECT_EQ(task.result, doubled(std::to_string(task.number)));
                        ++times[task.number];
                        order.push_back(task.number);
                    },
                .stop = std::move(stop)};
    }
    void expect_each_once() const {
        EXPECT_TRUE(std::ranges::all_of(times, [](int count) { return count == 1; }));
    }
};

/// Workers elsewhere that ask `asking` times for tasks at first, and answer the last task first.
class FakeWorkers {
public:
    explicit FakeWorkers(int asking) : waiting_(asking) {}
    [[nodiscard]] RemoteWorkers workers() {
        return {.receive =
                    [this] {
                        std::vector<DoneTask> done;
                        done.swap(tasks_);
                        std::ranges::reverse(done);
                        waiting_ += static_cast<int>(done.size());
                        return done;
                    },
                .give =
                    [this](std::size_t number, const std::string& task) {
                        if (waiting_ == 0) return false;
                        --waiting_;
                        ++given;
                        tasks_.push_back({.number = number, .result = doubled(task)});
                        return true;
                    }};
    }
    std::size_t given = 0;

private:
    int waiting_;
    std::vector<DoneTask> tasks_;
};

TEST(WorkerThreads, DoesEveryTaskOnce) {
    for (const int threads : {1, 2, 7}) {
        for (const std::size_t tasks : {0U, 1U, 3U, 500U}) {
            WorkerThreads here(threads, doubled);
            Taken taken(tasks);
            EXPECT_EQ(lead(here, taken.leading(), nullptr), tasks);
            taken.expect_each_once();
            EXPECT_EQ(here.outstanding(), 0U);
        }
    }
}

/// Leads `tasks` on two threads here beside the workers `elsewhere`, each of them once.
Taken led_beside(FakeWorkers& elsewhere, std::size_t tasks) {
    const RemoteWorkers workers = elsewhere.workers();
    WorkerThreads here(2, doubled);
    Taken taken(tasks);
    EXPECT_EQ(lead(here, taken.leading(), &workers), tasks);
    taken.expect_each_once();
    return taken;
}

TEST(WorkerThreads, SharesTasksWithWorkersElsewhere) {
    FakeWorkers elsewhere(3);
    const Taken taken = led_beside(elsewhere, 500);
    EXPECT_GT(elsewhere.given, 0U);
    EXPECT_FALSE(std::ranges::is_sorted(taken.order)) << "results came in another order than tasks went";
}

TEST(WorkerThreads, NeedsNoneElsewhere) {
    FakeWorkers elsewhere(0);
    (void)led_beside(elsewhere, 50);
    EXPECT_EQ(elsewhere.given, 0U);
}

TEST(WorkerThreads, GivesNothingAfterAStopAndTakesWhatHasBegun) {
    for (const bool remote : {false, true}) {
        FakeWorkers elsewhere(3);
        const RemoteWorkers workers = elsewhere.workers();
        std::atomic<int> begun = 0;
        WorkerThreads here(2, [&](const std::string& task) {
            ++begun;
            return doubled(task);
        });
        Taken taken(500);
        const std::size_t done =
            lead(here, taken.leading([&] { return taken.order.size() >= 10; }), remote ? &workers : nullptr);
        EXPECT_EQ(done, taken.order.size());
        EXPECT_EQ(done, static_cast<std::size_t>(begun) + elsewhere.given) << "nothing that had begun was dropped";
        EXPECT_GE(done, 10U);
        EXPECT_LT(done, 100U);
        EXPECT_TRUE(std::ranges::all_of(taken.times, [](int count) { return count <= 1; }));
    }
    WorkerThreads here(2, doubled);
    Taken taken(5);
    EXPECT_EQ(lead(here, taken.leading([] { return true; }), nullptr), 0U);
}

TEST(WorkerThreads, WhatTakingThrowsEndsIt) {
    WorkerThreads here(2, doubled);
    Taken taken(100);
    Leading leading = taken.leading();
    leading.take = [](const DoneTask&) { throw std::runtime_error("the disk is full"); };
    EXPECT_THROW(lead(here, leading, nullptr), std::runtime_error);
}

TEST(WorkerThreads, IsSentHomeWithTasksLeft) {
    std::atomic<int> begun = 0;
    {
        WorkerThreads here(2, [&](const std::string& task) {
            ++begun;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            return task;
        });
        for (std::size_t i = 0; i < 1000; ++i) here.give(i, "");
        EXPECT_TRUE(here.take(std::chrono::seconds(60)));
        EXPECT_EQ(here.outstanding(), 999U);
    }
    EXPECT_LT(begun, 1000);
}

}  // namespace
}  // namespace skinfit
