#include "explore/fit_jobs.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

#include "core/input_error.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::ptrdiff_t most_running = 2;
constexpr std::size_t most_ended = 8;

/// One thread is left to whoever moves a slider meanwhile.
int fitting_threads() {
    return std::max(1, tbb::this_task_arena::max_concurrency() - 1);
}

}  // namespace

struct FitJobs::Job {
    mutable std::mutex mutex;
    std::string state = "running";
    FitProgress progress{.stage = "waiting", .done = 0, .total = 1};
    Json outcome = Json::object();  ///< "documents" or "error"
    FitOrder order;
    std::optional<FitResult> result;  ///< of a fit that is done; never changes then
    Clock::time_point begin = Clock::now();
    Clock::time_point end{};
    std::jthread thread;  ///< last: it ends before the others

    void conclude(const std::string& how, Json with) {
        const std::scoped_lock lock(mutex);
        state = how;
        outcome = std::move(with);
        end = Clock::now();
    }

    [[nodiscard]] bool is_running() const {
        const std::scoped_lock lock(mutex);
        return state == "running";
    }

    void conclude(FitResult found) {
        Json documents = fitted_documents(found);
        {
            const std::scoped_lock lock(mutex);
            result = std::move(found);
        }
        conclude("done", {{"documents", std::move(documents)}});
    }

    void run(const std::stop_token& stop, const DiskCache& cache) {
        const FitWatch watch{.stop = stop, .progress = [this](const FitProgress& now) {
                                 const std::scoped_lock lock(mutex);
                                 progress = now;
                             }};
        try {
            tbb::task_arena arena(fitting_threads());
            conclude(arena.execute([&] { return fitted(order, cache, watch); }));
        } catch (const Cancelled&) {
            conclude("cancelled", Json::object());
        } catch (const InputError& error) {
            conclude("failed", {{"error", error.what()}});
        } catch (const std::exception& error) {
            conclude("failed", {{"error", std::string("internal error: ") + error.what()}});
        }
    }
};

std::optional<std::string> FitJobs::start(FitOrder order) {
    const std::scoped_lock lock(mutex_);
    if (std::ranges::count_if(jobs_, [](const auto& each) { return each.second->is_running(); }) >= most_running) {
        return std::nullopt;
    }
    forget_old();
    const auto job = std::make_shared<Job>();
    job->order = std::move(order);
    job->thread = std::jthread([job = job.get(), cache = cache_](std::stop_token stop) { job->run(stop, cache); });
    jobs_.emplace(++started_, job);
    return std::to_string(started_);
}

void FitJobs::forget_old() {
    const auto is_ended = [](const auto& each) { return !each.second->is_running(); };
    while (std::ranges::count_if(jobs_, is_ended) > static_cast<std::ptrdiff_t>(most_ended) - 1) {
        jobs_.erase(std::ranges::find_if(jobs_, is_ended));
    }
}

std::shared_ptr<FitJobs::Job> FitJobs::find(const std::string& name) const {
    const std::optional<std::uint64_t> number = parse_count(name);
    const std::scoped_lock lock(mutex_);
    if (!number || *number > static_cast<std::uint64_t>(started_)) return nullptr;
    const auto found = jobs_.find(static_cast<int>(*number));
    return found == jobs_.end() ? nullptr : found->second;
}

std::optional<Json> FitJobs::state(const std::string& name) const {
    const std::shared_ptr<Job> job = find(name);
    if (!job) return std::nullopt;
    const std::scoped_lock lock(job->mutex);
    const std::chrono::duration<double> elapsed = (job->state == "running" ? Clock::now() : job->end) - job->begin;
    Json json = {
        {"state", job->state},
        {"progress", {{"stage", job->progress.stage}, {"done", job->progress.done}, {"total", job->progress.total}}},
        {"seconds", elapsed.count()}};
    json.update(job->outcome);
    return json;
}

std::optional<std::string> FitJobs::page(const std::string& name) {
    const std::shared_ptr<Job> job = find(name);
    if (!job) return std::nullopt;
    {
        const std::scoped_lock lock(job->mutex);
        if (!job->result) return std::nullopt;
    }
    const std::scoped_lock lock(drawing_);
    return fitted_page(job->order, *job->result);
}

bool FitJobs::cancel(const std::string& name) {
    const std::shared_ptr<Job> job = find(name);
    return job && (job->thread.request_stop(), true);
}

}  // namespace skinfit
