#include "study/cube_ledger.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>

#include <filesystem>
#include <stdexcept>

#include "study/sqlite_errors.hpp"

namespace skinfit {
namespace {

Json counts_json(const StatusCounts& counts) {
    Json json = Json::object();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) json[std::string(fit_status_names[i])] = counts[i];
    }
    return json;
}

StatusCounts counts_from(const Ledger& ledger, const std::string& text) {
    return understood(ledger.path(), [&] {
        StatusCounts counts{};
        const Json json = Json::parse(text);
        for (const auto& [name, count] : json.items()) {
            counts[static_cast<std::size_t>(fit_status_named(name))] = count.get<std::uint64_t>();
        }
        return counts;
    });
}

SQLite::Statement bound(const Ledger& ledger, const char* query, const std::string& source) {
    SQLite::Statement statement(ledger.database(), query);
    statement.bind(1, source);
    return statement;
}

/// Where the file of a map is: names in the ledger are relative to its folder, so that both can be moved.
std::filesystem::path map_file(const Ledger& ledger, const std::string& name) {
    return ledger.path().parent_path() / name;
}

/// Whether what the ledger holds of the cube can stay.
bool stands(const Ledger& ledger, const CubeEntry& cube, const std::string& configuration_hash) {
    SQLite::Statement find =
        bound(ledger, "SELECT input_hash, configuration_hash, map FROM cubes WHERE source = ?", cube.source);
    if (!find.executeStep()) return false;
    const std::string map = find.getColumn(2).getString();
    return find.getColumn(0).getString() == cube.input_hash && find.getColumn(1).getString() == configuration_hash &&
           (map.empty() || std::filesystem::exists(map_file(ledger, map)));
}

/// The tiles of `cube` that the ledger does not hold yet.
void add_tiles(const Ledger& ledger, const CubeEntry& cube) {
    SQLite::Statement add(ledger.database(),
                          "INSERT OR IGNORE INTO tiles (source, first_line, lines) VALUES (?, ?, ?)");
    for (const CubeTile& tile : cube.tiles) {
        add.reset();
        SQLite::bind(add, cube.source, static_cast<std::int64_t>(tile.first_line),
                     static_cast<std::int64_t>(tile.lines));
        add.exec();
    }
}

/// Keeps what the ledger holds of a cube; false where it holds nothing. Those of its tiles that wait are those of
/// `cube`: it may have been another part's before.
bool keep_cube(const Ledger& ledger, const CubeEntry& cube, std::int64_t position) {
    SQLite::Statement keep(ledger.database(),
                           "UPDATE cubes SET present = 1, position = ?, metadata = ?, reason = ? WHERE source = ?");
    SQLite::bind(keep, position, metadata_json(cube.metadata).dump(), cube.problem.value_or(""), cube.source);
    if (keep.exec() == 0) return false;
    if (cube.problem) return true;
    bound(ledger, "DELETE FROM tiles WHERE source = ? AND counts IS NULL", cube.source).exec();
    add_tiles(ledger, cube);
    return true;
}

void add_cube(const Ledger& ledger, const CubeEntry& cube, std::int64_t position,
              const std::string& configuration_hash) {
    bound(ledger, "DELETE FROM cubes WHERE source = ?", cube.source).exec();
    SQLite::Statement add(ledger.database(),
                          "INSERT INTO cubes (source, position, metadata, input_hash, configuration_hash, reason) "
                          "VALUES (?, ?, ?, ?, ?, ?)");
    SQLite::bind(add, cube.source, position, metadata_json(cube.metadata).dump(), cube.input_hash, configuration_hash,
                 cube.problem.value_or(""));
    add.exec();
    add_tiles(ledger, cube);
}

CubeTile tile_in(const SQLite::Statement& query) {
    return {.first_line = static_cast<std::size_t>(query.getColumn(0).getInt64()),
            .lines = static_cast<std::size_t>(query.getColumn(1).getInt64())};
}

void count_tiles(const Ledger& ledger, CubeRow& row) {
    SQLite::Statement query = bound(ledger, "SELECT counts FROM tiles WHERE source = ?", row.source);
    while (query.executeStep()) {
        ++row.tiles;
        if (query.getColumn(0).isNull()) continue;
        ++row.tiles_done;
        const StatusCounts counts = counts_from(ledger, query.getColumn(0).getString());
        for (std::size_t i = 0; i < counts.size(); ++i) row.pixels[i] += counts[i];
    }
}

}  // namespace

void take_cubes(const Ledger& ledger, const std::vector<CubeEntry>& cubes, const std::string& configuration_hash) {
    translated(ledger.path(), [&] {
        SQLite::Transaction transaction(ledger.database());
        ledger.database().exec("UPDATE cubes SET present = 0");
        for (std::size_t i = 0; i < cubes.size(); ++i) {
            const auto position = static_cast<std::int64_t>(i);
            // What cannot be read now is no reason to lose what was found before.
            const bool stays = cubes[i].problem || stands(ledger, cubes[i], configuration_hash);
            if (stays && keep_cube(ledger, cubes[i], position)) continue;
            add_cube(ledger, cubes[i], position, configuration_hash);
        }
        transaction.commit();
    });
}

std::vector<CubeTile> pending_tiles(const Ledger& ledger, const std::string& source) {
    return translated(ledger.path(), [&] {
        SQLite::Statement query =
            bound(ledger, "SELECT first_line, lines FROM tiles WHERE source = ? AND counts IS NULL ORDER BY first_line",
                  source);
        std::vector<CubeTile> tiles;
        while (query.executeStep()) tiles.push_back(tile_in(query));
        return tiles;
    });
}

void store_tile(const Ledger& ledger, const std::string& source, const FittedTile& tile) {
    translated(ledger.path(), [&] {
        SQLite::Statement update(
            ledger.database(),
            "UPDATE tiles SET counts = ?, bytes = ?, seconds = ? WHERE source = ? AND first_line = ?");
        update.bind(1, counts_json(tile.pixels).dump());
        update.bind(2, tile.bytes.data(), static_cast<int>(tile.bytes.size()));
        update.bind(3, tile.seconds);
        update.bind(4, source);
        update.bind(5, static_cast<std::int64_t>(tile.tile.first_line));
        if (update.exec() != 1) throw std::logic_error("the ledger holds no such tile of " + source);
    });
}

void refuse_cube(const Ledger& ledger, const std::string& source, const std::string& reason) {
    translated(ledger.path(), [&] {
        SQLite::Statement update(ledger.database(), "UPDATE cubes SET reason = ? WHERE source = ?");
        SQLite::bind(update, reason, source);
        update.exec();
    });
}

std::vector<CubeRow> cube_rows(const Ledger& ledger) {
    return translated(ledger.path(), [&] {
        SQLite::Statement query(
            ledger.database(),
            "SELECT source, metadata, configuration_hash, reason, map FROM cubes WHERE present ORDER BY position");
        std::vector<CubeRow> rows;
        while (query.executeStep()) {
            const auto text = [&](int column) { return query.getColumn(column).getString(); };
            rows.push_back({.source = text(0),
                            .metadata = understood(ledger.path(), [&] { return metadata_from(Json::parse(text(1))); }),
                            .configuration_hash = text(2),
                            .reason = text(3),
                            .map = text(4).empty() ? std::string() : map_file(ledger, text(4)).string()});
            count_tiles(ledger, rows.back());
        }
        return rows;
    });
}

void for_each_tile(const Ledger& ledger, const std::string& source, const std::function<void(const FittedTile&)>& use) {
    translated(ledger.path(), [&] {
        SQLite::Statement query = bound(ledger,
                                        "SELECT first_line, lines, counts, bytes, seconds FROM tiles WHERE source = ? "
                                        "AND bytes IS NOT NULL ORDER BY first_line",
                                        source);
        while (query.executeStep()) {
            use({.tile = tile_in(query),
                 .pixels = counts_from(ledger, query.getColumn(2).getString()),
                 .bytes = query.getColumn(3).getString(),
                 .seconds = query.getColumn(4).getDouble()});
        }
    });
}

void finish_cube(const Ledger& ledger, const std::string& source, const std::string& map) {
    translated(ledger.path(), [&] {
        SQLite::Transaction transaction(ledger.database());
        SQLite::Statement update(ledger.database(), "UPDATE cubes SET map = ? WHERE source = ?");
        SQLite::bind(update, map, source);
        update.exec();
        bound(ledger, "UPDATE tiles SET bytes = NULL WHERE source = ?", source).exec();
        transaction.commit();
    });
}

}  // namespace skinfit
