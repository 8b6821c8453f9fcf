#pragma once

#include <optional>

#include "study/study_run.hpp"

namespace skinfit {

/// How many processes of this program an MPI launcher has started together; 1 where none has.
[[nodiscard]] int launched_processes();

/// `run_study` by all processes that an MPI launcher has started together: the first alone writes the ledger and
/// returns what was done, the others fit what it gives them and return nothing. Answers are those of a single process.
/// Throws InputError as `run_study`, and for several processes in a program that was built without MPI.
[[nodiscard]] std::optional<StudyRun> run_study_together(const Study& study, const StudyRunOptions& options);

}  // namespace skinfit
