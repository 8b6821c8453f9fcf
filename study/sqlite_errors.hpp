#pragma once

#include <SQLiteCpp/Exception.h>

#include <filesystem>

namespace skinfit {

/// Throws the InputError that says of the ledger at `path` what SQLite says in its own words.
[[noreturn]] void refuse_sqlite(const SQLite::Exception& error, const std::filesystem::path& path);

/// What `work` gives, with SQLite's exceptions translated.
template <class Work>
auto translated(const std::filesystem::path& path, const Work& work) {
    try {
        return work();
    } catch (const SQLite::Exception& error) {
        refuse_sqlite(error, path);
    }
}

}  // namespace skinfit
