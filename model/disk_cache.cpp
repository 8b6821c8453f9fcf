#include "model/disk_cache.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace skinfit {
namespace {

constexpr std::array<std::string_view, 2> kinds = {"paths", "emulator"};

bool is_of_the_cache(const std::filesystem::path& path) {
    return std::ranges::any_of(kinds,
                               [&](std::string_view kind) { return path.extension() == fmt::format(".{}", kind); });
}

/// Removes the longest unused files until `limit_bytes` holds the rest.
void make_room(const std::filesystem::path& folder, std::uint64_t limit_bytes) {
    struct File {
        std::filesystem::path path;
        std::filesystem::file_time_type used;
        std::uint64_t bytes;
    };
    std::vector<File> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (!is_of_the_cache(entry.path())) continue;
        const File file{entry.path(), entry.last_write_time(error), entry.file_size(error)};
        if (!error) files.push_back(file);
    }
    std::ranges::sort(files, std::ranges::greater{}, &File::used);
    std::uint64_t kept = 0;
    for (const File& file : files) {
        kept += file.bytes;
        if (kept > limit_bytes) std::filesystem::remove(file.path, error);
    }
}

}  // namespace

std::optional<std::filesystem::path> default_cache_folder() {
    const auto variable = [](const char* name) -> std::optional<std::filesystem::path> {
        const char* const value = std::getenv(name);
        if (value == nullptr || *value == '\0') return std::nullopt;
        return value;
    };
    if (auto folder = variable("SKINFIT_CACHE_DIR")) return folder;
    if (const auto folder = variable("XDG_CACHE_HOME")) return *folder / "skinfit";
    if (const auto folder = variable("HOME")) return *folder / ".cache" / "skinfit";
    return std::nullopt;
}

std::filesystem::path cache_file(const std::filesystem::path& folder, std::string_view key, std::string_view kind) {
    const XXH128_hash_t hash = XXH3_128bits(key.data(), key.size());
    return folder / fmt::format("{:016x}{:016x}.{}", hash.high64, hash.low64, kind);
}

void mark_used(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
}

void keep(const DiskCache& cache, const std::function<void()>& write) {
    try {
        std::error_code error;
        std::filesystem::create_directories(*cache.folder, error);
        write();
        make_room(*cache.folder, cache.limit_bytes);
    } catch (const InputError& problem) {
        cache.warn(fmt::format("nothing is kept for the next run: {}", problem.what()));
    }
}

}  // namespace skinfit
