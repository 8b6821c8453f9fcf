#include "study/ledger_schema.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include "core/file_replacement.hpp"
#include "core/input_error.hpp"
#include "study/sqlite_errors.hpp"

namespace skinfit {
namespace {

/// One row per spectrum; lists are JSON. `present` is 0 for what is no part of the study any more. `seconds` and
/// `finished_at` say how a run went, everything else what it found.
constexpr const char* tables = R"sql(
CREATE TABLE spectra (
    id INTEGER PRIMARY KEY,
    source TEXT NOT NULL,
    number INTEGER NOT NULL,
    name TEXT NOT NULL,
    present INTEGER NOT NULL DEFAULT 1,
    position INTEGER NOT NULL,
    metadata TEXT NOT NULL,
    input_hash TEXT NOT NULL,
    configuration_hash TEXT NOT NULL,
    status TEXT NOT NULL CHECK (status IN ('pending', 'fitted', 'suspect', 'rejected', 'failed')),
    verdict TEXT NOT NULL DEFAULT '',
    reason TEXT NOT NULL DEFAULT '',
    parameters TEXT NOT NULL DEFAULT '[]',
    correlation TEXT NOT NULL DEFAULT '[]',
    tissue TEXT NOT NULL DEFAULT '[]',
    indices TEXT NOT NULL DEFAULT '[]',
    rmse REAL,
    chi2 REAL,
    degrees_of_freedom REAL,
    p_value REAL,
    seconds REAL NOT NULL DEFAULT 0,
    finished_at TEXT,
    UNIQUE (source, number, name));
CREATE INDEX spectra_by_status ON spectra (present, status);
CREATE TABLE cubes (
    source TEXT PRIMARY KEY,
    present INTEGER NOT NULL DEFAULT 1,
    position INTEGER NOT NULL,
    metadata TEXT NOT NULL,
    input_hash TEXT NOT NULL,
    configuration_hash TEXT NOT NULL,
    reason TEXT NOT NULL DEFAULT '',
    map TEXT NOT NULL DEFAULT '');
CREATE TABLE tiles (
    source TEXT NOT NULL REFERENCES cubes (source) ON DELETE CASCADE,
    first_line INTEGER NOT NULL,
    lines INTEGER NOT NULL,
    counts TEXT,
    bytes BLOB,
    seconds REAL NOT NULL DEFAULT 0,
    PRIMARY KEY (source, first_line));
CREATE TABLE notes (name TEXT PRIMARY KEY, text TEXT NOT NULL);
)sql";

constexpr int patience_ms = 5000;

/// The file at `path` as a URI.
std::string uri_of(const std::filesystem::path& path) {
    std::string uri = "file:";
    for (const char c : path.string()) {
        uri += std::string_view("%?#").find(c) == std::string_view::npos
                   ? std::string(1, c)
                   : fmt::format("%{:02x}", static_cast<unsigned char>(c));
    }
    return uri;
}

/// Whether answers lie beside the file that have not been moved into it.
bool has_log(const std::filesystem::path& path) {
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(path.string() + "-wal", none);
    return !none && size > 0;
}

/// The definitions of a ledger's tables, as the database keeps them.
std::string definitions_in(const SQLite::Database& database) {
    SQLite::Statement query(database,
                            "SELECT sql FROM sqlite_master WHERE name IN ('spectra', 'spectra_by_status', 'cubes', "
                            "'tiles', 'notes') ORDER BY name");
    std::string definitions;
    while (query.executeStep()) definitions += query.getColumn(0).getString();
    return definitions;
}

std::string right_definitions() {
    SQLite::Database empty(":memory:", SQLite::OPEN_READWRITE);
    empty.exec(tables);
    return definitions_in(empty);
}

void check_kind(const SQLite::Database& database, const std::filesystem::path& path) {
    const auto pragma = [&](const char* query) {
        SQLite::Statement statement(database, query);
        return statement.executeStep() ? statement.getColumn(0).getInt() : 0;
    };
    if (pragma("PRAGMA application_id") != ledger_application_id) {
        throw InputError({.where = path.string(),
                          .problem = "is no ledger",
                          .why = "it is a database of another program",
                          .remedy = "name another output folder, or move this file away"});
    }
    const int version = pragma("PRAGMA user_version");
    if (version != ledger_schema_version) {
        throw InputError({.where = path.string(),
                          .problem = fmt::format("has tables of version {}", version),
                          .why = fmt::format("this program knows version {}", ledger_schema_version),
                          .remedy = "use the program that wrote it, or another output folder"});
    }
    if (definitions_in(database) != right_definitions()) refuse_damaged(path, "its tables are not those of a ledger");
}

void make_tables(SQLite::Database& database) {
    SQLite::Transaction transaction(database);
    database.exec(fmt::format("PRAGMA application_id = {}", ledger_application_id));
    database.exec(fmt::format("PRAGMA user_version = {}", ledger_schema_version));
    database.exec(tables);
    transaction.commit();
}

void check_through(SQLite::Database& database, const std::filesystem::path& path) {
    const std::string answer = database.execAndGet("PRAGMA quick_check(1)").getString();
    if (answer != "ok") refuse_damaged(path, answer);
}

/// What `work`, which opens a file, gives. Its questions fit every database, so that an error in them is the file's.
template <class Work>
auto opened(const std::filesystem::path& path, const Work& work) {
    return translated(path, [&] {
        try {
            return work();
        } catch (const SQLite::Exception& error) {
            if (error.getErrorCode() == SQLITE_ERROR) refuse_damaged(path, error.what());
            throw;
        }
    });
}

}  // namespace

std::unique_ptr<SQLite::Database> open_ledger_to_write(const std::filesystem::path& path) {
    refuse_link(path);
    return opened(path, [&] {
        auto database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                                                           patience_ms);
        const bool is_new = database->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0 &&
                            database->execAndGet("PRAGMA application_id").getInt() == 0;
        if (is_new) {
            make_tables(*database);
        } else {
            check_kind(*database, path);
            check_through(*database, path);
        }
        const std::string mode = database->execAndGet("PRAGMA journal_mode = WAL").getString();
        if (mode != "wal") {
            throw InputError({.where = path.string(),
                              .problem = "cannot be used as a ledger",
                              .why = fmt::format("its file system lacks what SQLite's write-ahead log needs; it allows "
                                                 "only the journal mode {}",
                                                 mode),
                              .remedy = "put the output folder on a local disk"});
        }
        // A crash of the program loses nothing; one of the machine at most the last transactions.
        database->exec("PRAGMA synchronous = NORMAL");
        database->exec("PRAGMA foreign_keys = ON");
        return database;
    });
}

std::unique_ptr<SQLite::Database> open_ledger_to_read(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) {
        throw InputError({.where = path.string(),
                          .problem = "there is no ledger",
                          .why = "the study has not been run",
                          .remedy = "run it with `skinfit study run`"});
    }
    return opened(path, [&] {
        const auto open = [&](const std::string& name, int flags) {
            auto database = std::make_unique<SQLite::Database>(name, SQLite::OPEN_READONLY | flags, patience_ms);
            check_kind(*database, path);
            return database;
        };
        try {
            return open(path.string(), 0);
        } catch (const SQLite::Exception& error) {
            // In a folder that cannot be written there is no place for what readers and writers share; nor is there a
            // writer.
            const bool cannot_share =
                error.getErrorCode() == SQLITE_CANTOPEN || error.getErrorCode() == SQLITE_READONLY;
            if (!cannot_share || has_log(path)) throw;
            return open(uri_of(path) + "?immutable=1", SQLite::OPEN_URI);
        }
    });
}

}  // namespace skinfit
