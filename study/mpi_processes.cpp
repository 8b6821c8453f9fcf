#include "study/mpi_job.hpp"
#include "study/study_processes.hpp"

// Of a program that was built with MPI.
namespace skinfit {

std::optional<StudyRun> run_study_together(const Study& study, const StudyRunOptions& options) {
    if (launched_processes() == 1) return run_study(study, options);
    MpiJob job;
    if (!job.leads()) {
        WorkerThreads threads(options.jobs, study_worker(std::make_shared<StudyReader>(study), options.cache));
        job.follow(threads);
        return std::nullopt;
    }
    const RemoteWorkers followers = job.followers();
    StudyRunOptions together = options;
    together.remote = &followers;
    return run_study(study, together);
}

}  // namespace skinfit
