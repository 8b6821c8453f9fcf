#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/worker_threads.hpp"

namespace skinfit {

/// The processes of an MPI job that run one study together: the first leads and alone writes the ledger, the others
/// follow. One of them that dies takes its tasks with it, and by default mpirun ends the job; what was stored stays,
/// and the next run does the rest. There may be one job in a program.
class MpiJob {
public:
    /// Joins the job that this process was started in.
    MpiJob();
    MpiJob(const MpiJob&) = delete;
    MpiJob& operator=(const MpiJob&) = delete;
    /// Of the leader: dismisses the followers. Waits for all processes of the job.
    ~MpiJob();

    [[nodiscard]] bool leads() const { return rank_ == 0; }

    /// The followers, for the leader. Calls must come from the thread that made this.
    [[nodiscard]] RemoteWorkers followers();

    /// Does what the leader gives until it dismisses this process.
    void follow(WorkerThreads& threads) const;

private:
    [[nodiscard]] std::vector<DoneTask> receive();
    [[nodiscard]] bool give(std::size_t number, const std::string& task);

    int rank_ = 0;
    int size_ = 1;
    std::vector<std::size_t> waiting_;  // tasks that each process would take now
};

}  // namespace skinfit
