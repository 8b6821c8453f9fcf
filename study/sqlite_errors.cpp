#include "study/sqlite_errors.hpp"

#include <sqlite3.h>

#include <string>

#include "core/input_error.hpp"

namespace skinfit {

void refuse_sqlite(const SQLite::Exception& error, const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& problem, const std::string& remedy) {
        throw InputError({.where = path.string(), .problem = problem, .why = error.what(), .remedy = remedy});
    };
    switch (error.getErrorCode()) {
        case SQLITE_FULL:
            refuse("cannot grow", "make space and run the study again: everything stored so far is kept");
            break;
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_CANTOPEN:
            refuse("cannot be opened", "check that it exists, and that it and its folder may be read and written");
            break;
        case SQLITE_NOTADB:
            refuse("is no ledger", "name another output folder, or move this file away");
            break;
        case SQLITE_CORRUPT:
            refuse_damaged(path, error.what());
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            refuse("is in use", "wait for the other process, or stop it");
            break;
        case SQLITE_IOERR:
            refuse("cannot be read or written",
                   "check the disk; then run the study again: everything stored so far is kept");
            break;
        default:
            break;
    }
    throw;  // a bug of ours
}

void refuse_damaged(const std::filesystem::path& path, const std::string& why) {
    throw InputError({.where = path.string(),
                      .problem = "is damaged",
                      .why = why,
                      .remedy = "restore a copy, or move it away and run the study again"});
}

}  // namespace skinfit
