#pragma once

#include <filesystem>
#include <memory>

namespace SQLite {
class Database;
}

namespace skinfit {

/// The version of the tables that this program writes, kept in the database's `user_version`.
inline constexpr int ledger_schema_version = 2;

/// Marks SQLite files that are ledgers, in the database's `application_id`: "skfi".
inline constexpr int ledger_application_id = 0x736b6669;

/// The database at `path`, made where there is none, with all tables, in WAL mode. Checks it through. Throws InputError
/// for a file that is damaged, no ledger, or of a later version.
[[nodiscard]] std::unique_ptr<SQLite::Database> open_ledger_to_write(const std::filesystem::path& path);

/// The database at `path`. Throws InputError as above, and where there is none.
[[nodiscard]] std::unique_ptr<SQLite::Database> open_ledger_to_read(const std::filesystem::path& path);

}  // namespace skinfit
