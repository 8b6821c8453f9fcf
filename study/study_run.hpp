#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/disk_cache.hpp"
#include "study/ledger.hpp"
#include "study/study.hpp"
#include "study/study_reader.hpp"
#include "study/worker_threads.hpp"

namespace skinfit {

/// A share of a study, for machines that do not talk to each other.
struct StudyPart {
    std::size_t number = 1;  ///< from 1
    std::size_t parts = 1;
};

/// How far a run is.
struct StudyProgress {
    std::size_t spectra = 0;  ///< finished in this run
    std::size_t spectra_to_do = 0;
    std::uint64_t pixels = 0;
    std::uint64_t pixels_to_do = 0;
};

/// How a study is run, and who is told.
struct StudyRunOptions {
    int jobs = 1;  ///< threads
    DiskCache cache;
    std::optional<StudyPart> part{};  ///< unset: all of it
    std::filesystem::path ledger;     ///< `ledger_path` of the study, or one of its own for a part
    std::function<void(const StudyProgress&)> progress;
    std::function<void(const std::string&)> tell;  ///< what happened, a line each
    std::function<bool()> stop;                    ///< whether to end early, with what has begun finished
    const RemoteWorkers* remote = nullptr;         ///< other processes that run `study_worker` of the same study
};

/// What a run did.
struct StudyRun {
    RosterChange change;
    std::size_t left_out = 0;  ///< spectra whose names the study's patterns do not know
    StudyProgress progress;
    std::size_t undrawn_maps = 0;  ///< maps that are written, but their pictures not drawn
    bool stopped = false;
};

/// Where a study keeps its results.
[[nodiscard]] std::filesystem::path ledger_path(const Study& study);

/// What decides the answers beside the spectra: settings of the fits, the instrument, accepted findings, the program's
/// version.
[[nodiscard]] std::string configuration_hash_of(const Study& study);

/// Does the tasks of a run of the reader's study; the same in every process.
[[nodiscard]] Worker study_worker(std::shared_ptr<StudyReader> reader, const DiskCache& cache);

/// Fits whatever of the study has not been fitted, and keeps each answer in the ledger as soon as it is there. Whatever
/// ends the program, running it again goes on where it was. Throws InputError where the ledger is in use or cannot be
/// written and for settings with which nothing can be fitted; what is wrong with a spectrum is a result.
StudyRun run_study(const Study& study, const StudyRunOptions& options);

/// Makes the ledger at `options.ledger` hold the study and whatever the ledgers of its parts know of it. Answers from
/// other inputs or settings are not taken. Throws InputError as `Ledger`.
StudyRun merge_study(const Study& study, const std::vector<std::filesystem::path>& parts,
                     const StudyRunOptions& options);

}  // namespace skinfit
