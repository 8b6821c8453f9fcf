#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "study/cube_ledger.hpp"
#include "study/ledger.hpp"

/// The pieces into which a study's work is cut, and what comes of them; as bytes they travel between processes.
namespace skinfit {

/// A spectrum to be fitted, as the plan of the run knows it.
struct TaskedSpectrum {
    std::size_t number;  ///< as `RosterEntry`
    std::string name;
    std::string input_hash;
};

/// Some spectra of one file. Those that are no longer what the plan knew, because the file has been edited meanwhile,
/// are left to the next run.
struct SpectraTask {
    std::size_t file;  ///< of `Study::files`
    std::vector<TaskedSpectrum> spectra;
};

/// A tile of a cube.
struct TileTask {
    std::size_t cube;  ///< of `Study::cubes`
    CubeTile tile;
};

using StudyTask = std::variant<SpectraTask, TileTask>;

struct SpectraDone {
    std::vector<Ledger::Answer> answers;
};

struct TileDone {
    std::size_t cube;
    FittedTile tile;
    std::string problem;  ///< why there are no bytes; empty where there are
};

using StudyDone = std::variant<SpectraDone, TileDone>;

[[nodiscard]] std::string bytes_of(const StudyTask& task);
[[nodiscard]] StudyTask task_in(const std::string& bytes);
[[nodiscard]] std::string bytes_of(const SpectraDone& done);
[[nodiscard]] std::string bytes_of(const TileDone& done);
[[nodiscard]] StudyDone done_in(const std::string& bytes);

}  // namespace skinfit
