#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/ledger.hpp"

/// The part of a ledger that holds hyperspectral images, tile by tile.
namespace skinfit {

/// Some whole lines of a cube.
struct CubeTile {
    std::size_t first_line;
    std::size_t lines;
};

/// A cube of a study, before it is fitted.
struct CubeEntry {
    std::string source;
    Metadata metadata;
    std::string input_hash;
    std::optional<std::string> problem;  ///< why it cannot be read
    std::uint64_t samples = 0;           ///< pixels in a line
    std::vector<CubeTile> tiles;         ///< all its lines, in order
};

/// What became of a tile.
struct FittedTile {
    CubeTile tile;
    StatusCounts pixels{};
    std::string bytes;
    double seconds = 0.0;
};

/// A cube in the ledger.
struct CubeRow {
    std::string source;
    Metadata metadata;
    std::string configuration_hash;
    std::string reason;  ///< why it has no map; empty where nothing is wrong
    std::string map;     ///< the file of its map; empty as long as there is none
    std::size_t tiles = 0;
    std::size_t tiles_done = 0;
    StatusCounts pixels{};  ///< of the tiles that are done
};

/// Makes the ledger hold these cubes, in their order. Tiles fitted from the same input with the same
/// `configuration_hash` stay, unless the cube's map has been written and is no longer there; so does everything of a
/// cube that cannot be read now.
void take_cubes(const Ledger& ledger, const std::vector<CubeEntry>& cubes, const std::string& configuration_hash);

/// The tiles of a cube that wait.
[[nodiscard]] std::vector<CubeTile> pending_tiles(const Ledger& ledger, const std::string& source);

void store_tile(const Ledger& ledger, const std::string& source, const FittedTile& tile);

/// Notes why a cube has no map.
void refuse_cube(const Ledger& ledger, const std::string& source, const std::string& reason);

[[nodiscard]] std::vector<CubeRow> cube_rows(const Ledger& ledger);

/// Calls `use` with the tiles of a cube that are done and whose bytes are kept, in order.
void for_each_tile(const Ledger& ledger, const std::string& source, const std::function<void(const FittedTile&)>& use);

/// Notes that the map of a cube stands in the file `map`, relative to the ledger's folder, and drops the bytes of its
/// tiles.
void finish_cube(const Ledger& ledger, const std::string& source, const std::string& map);

}  // namespace skinfit
