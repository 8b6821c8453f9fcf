#include "model/disk_cache.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "core/file_replacement.hpp"

namespace skinfit {
namespace {

constexpr std::array<std::string_view, 2> kinds = {"paths", "emulator"};

bool is_of_the_cache(const std::filesystem::path& path) {
    return std::ranges::any_of(kinds,
                               [&](std::string_view kind) { return path.extension() == fmt::format(".{}", kind); });
}

/// Whether the file is being written by a process, or was by one that was killed; release 0.1.0 added six letters to
/// the name of the file to come.
bool is_half_written(const std::filesystem::path& path) {
    return is_partial(path) || (path.extension().string().size() == 7 && is_of_the_cache(path.stem()));
}

}  // namespace

void tidy(const DiskCache& cache) {
    struct File {
        std::filesystem::path path;
        std::filesystem::file_time_type used;
        std::uint64_t bytes;
    };
    std::vector<File> files;
    std::uint64_t kept = 0;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(*cache.folder, error)) {
        if (!std::filesystem::is_regular_file(entry.symlink_status(error))) continue;
        const File file{entry.path(), entry.last_write_time(error), entry.file_size(error)};
        if (error) continue;
        if (is_of_the_cache(file.path)) files.push_back(file);
        if (is_half_written(file.path) && !remove_leftover(file.path)) kept += file.bytes;
    }
    std::ranges::sort(files, std::ranges::greater{}, &File::used);
    for (const File& file : files) {
        kept += file.bytes;
        if (kept > cache.limit_bytes) std::filesystem::remove(file.path, error);
    }
}

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
        tidy(cache);
    } catch (const InputError& problem) {
        cache.warn(fmt::format("nothing is kept for the next run: {}", problem.what()));
    }
}

}  // namespace skinfit
