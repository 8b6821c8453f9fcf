#include "model/ensemble_cache.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdlib>
#include <span>

#include "core/input_error.hpp"
#include "model/ensemble_file.hpp"

namespace skinfit {
namespace {

constexpr const char* file_suffix = ".paths";

/// A few rays of the recording asked for, hashed: any change to the walk, its tables or its random numbers shows here,
/// so that what an earlier version of the program has kept is never mistaken for this one's.
std::uint64_t walk_fingerprint(const Sample& sample, const std::vector<double>& wavelengths_nm, WalkOptions options) {
    options.rays = PathEnsemble::batch_count;
    const PathEnsemble probe = PathEnsemble::trace(sample, wavelengths_nm, options);
    const std::span<const float> lengths = probe.recording().lengths;
    return XXH3_64bits(lengths.data(), lengths.size_bytes());
}

/// Refuses a recording that this machine's memory cannot hold, before hours have gone into it.
void require_memory(std::size_t wavelengths, std::uint64_t rays) {
    constexpr double gigabyte = 1e9;
    const double needed = static_cast<double>(wavelengths) * static_cast<double>(rays) * sizeof(PerLayer<float>);
    const double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    constexpr double usable_share = 0.7;
    if (needed <= usable_share * memory) return;
    throw InputError(
        {.where = "rays",
         .problem = fmt::format("{} rays at {} wavelengths fill {:.0f} GB", rays, wavelengths, needed / gigabyte),
         .why =
             fmt::format("engine paths keeps every path, and this machine has {:.0f} GB of memory", memory / gigabyte),
         .remedy = "lower rays, take fewer wavelengths, or use engine walk or solver"});
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
        if (entry.path().extension() != file_suffix) continue;
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

std::string ensemble_key(const Sample& sample, const std::vector<double>& wavelengths_nm, const WalkOptions& options) {
    const Skin& skin = sample.skin;
    const bool has_index = sample.base.kind == Base::Kind::index;
    // Hexadecimal floating point: exact.
    return fmt::format(
        "walk {:x}; edition {}; layers {}; base {} {:a}; incidence {:a}; seed {}; rays {}; "
        "refractive indices {:a}; fibre {:a}; radius {:a}; dermis {:a} {:a}; wavelengths {:a}",
        walk_fingerprint(sample, wavelengths_nm, options), sample.edition == Edition::printed ? "printed" : "revised",
        sample.layers, static_cast<int>(sample.base.kind), has_index ? sample.base.refractive_index : 0.0,
        options.incidence_rad, options.seed, options.rays, fmt::join(refractive_index(skin), " "),
        skin.fibre_refractive_index, skin.fibril_radius_nm, skin.papillary_dermis_thickness_cm,
        skin.reticular_dermis_thickness_cm, fmt::join(wavelengths_nm, " "));
}

PathEnsemble cached_ensemble(const Sample& sample, const std::vector<double>& wavelengths_nm,
                             const WalkOptions& options, const EnsembleCache& cache) {
    require_memory(wavelengths_nm.size(), options.rays);
    const auto trace = [&] {
        cache.inform(fmt::format("recording {} walks at each of {} wavelengths", options.rays, wavelengths_nm.size()));
        return PathEnsemble::trace(sample, wavelengths_nm, options);
    };
    if (!cache.folder) return trace();
    const std::string key = ensemble_key(sample, wavelengths_nm, options);
    const XXH128_hash_t hash = XXH3_128bits(key.data(), key.size());
    const std::filesystem::path path =
        *cache.folder / fmt::format("{:016x}{:016x}{}", hash.high64, hash.low64, file_suffix);
    std::error_code error;
    if (std::filesystem::exists(path, error)) {
        auto stored = read_ensemble_file(path, key);
        if (auto* const ensemble = std::get_if<PathEnsemble>(&stored)) {
            std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now(), error);
            return *ensemble;
        }
        cache.warn(fmt::format("{}: the cached ensemble is {}; it is traced again and replaced", path.string(),
                               std::get<Unusable>(stored).reason));
    }
    PathEnsemble ensemble = trace();
    try {
        std::filesystem::create_directories(*cache.folder, error);
        write_ensemble_file(path, key, ensemble);
        make_room(*cache.folder, cache.limit_bytes);
    } catch (const InputError& problem) {
        cache.warn(fmt::format("the ensemble is not kept for the next run: {}", problem.what()));
    }
    return ensemble;
}

std::optional<std::filesystem::path> default_cache_folder() {
    const auto variable = [](const char* name) -> std::optional<std::filesystem::path> {
        const char* const value = std::getenv(name);
        if (value == nullptr || *value == '\0') return std::nullopt;
        return value;
    };
    if (const auto folder = variable("SKINFIT_CACHE_DIR")) return folder;
    if (const auto folder = variable("XDG_CACHE_HOME")) return *folder / "skinfit";
    if (const auto folder = variable("HOME")) return *folder / ".cache" / "skinfit";
    return std::nullopt;
}

}  // namespace skinfit
