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

/// Some spectra of one file.
struct SpectraTask {
    std::size_t file;                  ///< of `Study::files`
    std::vector<std::size_t> numbers;  ///< in the file, as `RosterEntry::number`
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
