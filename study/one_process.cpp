#include <fmt/format.h>

#include "core/input_error.hpp"
#include "study/study_processes.hpp"

// Of a program that was built without MPI.
namespace skinfit {

std::optional<StudyRun> run_study_together(const Study& study, const StudyRunOptions& options) {
    if (launched_processes() == 1) return run_study(study, options);
    throw InputError({.where = "mpirun",
                      .problem = fmt::format("has started {} processes", launched_processes()),
                      .why = "this skinfit was built without MPI, and they cannot share a ledger",
                      .remedy = "build it with -DSKINFIT_MPI=ON, or run one process with --threads"});
}

}  // namespace skinfit
