#pragma once

#include <SQLiteCpp/Exception.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/json.hpp"

namespace skinfit {

/// Throws the InputError that says of the ledger at `path` what SQLite says in its own words.
[[noreturn]] void refuse_sqlite(const SQLite::Exception& error, const std::filesystem::path& path);

/// Throws the InputError of a ledger that holds what no program of ours has written.
[[noreturn]] void refuse_damaged(const std::filesystem::path& path, const std::string& why);

/// What `work` makes of texts of the ledger; texts that make no sense are damage.
template <class Work>
auto understood(const std::filesystem::path& path, const Work& work) {
    try {
        return work();
    } catch (const Json::exception& error) {
        refuse_damaged(path, error.what());
    } catch (const std::out_of_range& error) {
        refuse_damaged(path, error.what());
    }
}

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
