#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/input_error.hpp"
#include "model/stored_file.hpp"

namespace skinfit {

/// What is costly to make, kept on disk between runs, in one folder, at most `limit_bytes` of it: the longest unused
/// goes first.
struct DiskCache {
    std::optional<std::filesystem::path> folder;  ///< none: nothing is kept
    /// Told, once a file, of what is wrong with the cache.
    std::function<void(const std::string&)> warn = [](const std::string&) {};
    /// Told before something costly starts.
    std::function<void(const std::string&)> inform = [](const std::string&) {};
    std::uint64_t limit_bytes = std::uint64_t{2} << 30U;
};

/// $SKINFIT_CACHE_DIR, else $XDG_CACHE_HOME/skinfit, else $HOME/.cache/skinfit; none where all are unset.
[[nodiscard]] std::optional<std::filesystem::path> default_cache_folder();

/// The file of `key` in a cache; `kind` is one of the kinds that are cached, and the ending of the file's name.
[[nodiscard]] std::filesystem::path cache_file(const std::filesystem::path& folder, std::string_view key,
                                               std::string_view kind);

/// Marks a file of the cache as used now.
void mark_used(const std::filesystem::path& file);

/// Removes from the folder of `cache` what killed processes have left half written, and the longest unused files until
/// the limit holds the rest and what others are writing.
void tidy(const DiskCache& cache);

/// Makes the folder of `cache`, calls `write`, and tidies it. A folder that
/// cannot be written is reported and does no harm.
void keep(const DiskCache& cache, const std::function<void()>& write);

/// What `read` gives for the file of `key`, or what `make` makes, which is then kept by `write`. A file that is
/// damaged, truncated, foreign or another user's is reported to `cache.warn` and replaced; a link, or what is no
/// ordinary file, stays.
template <class Value>
Value cached(const DiskCache& cache, const std::string& key, std::string_view kind, const std::function<Value()>& make,
             const std::function<std::variant<Value, Unusable>(const std::filesystem::path&, std::string_view)>& read,
             const std::function<void(const std::filesystem::path&, std::string_view, const Value&)>& write) {
    const std::filesystem::path file = cache_file(cache.folder.value(), key, kind);
    std::error_code error;
    if (std::filesystem::exists(file, error)) {
        auto stored = read(file, key);
        if (auto* const value = std::get_if<Value>(&stored)) {
            mark_used(file);
            return std::move(*value);
        }
        cache.warn(file.string() + ": what the cache holds is " + std::get<Unusable>(stored).reason +
                   "; it is made again");
    }
    Value value = make();
    keep(cache, [&] { write(file, key, value); });
    return value;
}

}  // namespace skinfit
