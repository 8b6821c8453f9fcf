#include "model/ensemble_cache.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "core/input_error.hpp"
#include "model/ensemble_file.hpp"
#include "model/sample_key.hpp"

namespace skinfit {
namespace {

/// Refuses a recording that this machine's memory cannot hold, before hours have gone into it.
void require_memory(std::size_t wavelengths, std::uint64_t rays) {
    constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
    const double needed = static_cast<double>(wavelengths) * static_cast<double>(rays) * sizeof(PerLayer<float>);
    const double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    constexpr double usable_share = 0.7;
    if (needed <= usable_share * memory) return;
    throw InputError(
        {.where = "rays",
         .problem = fmt::format("{} rays at {} wavelengths fill {:.0f} GiB", rays, wavelengths, needed / gibibyte),
         .why =
             fmt::format("engine paths keeps every path, and this machine has {:.0f} GiB of memory", memory / gibibyte),
         .remedy = "lower rays, take fewer wavelengths, or set engine=solver or engine=emulator"});
}

}  // namespace

std::string ensemble_key(const Sample& sample, const std::vector<double>& wavelengths_nm, const WalkOptions& options) {
    return fmt::format("program {:x}; seed {}; rays {}; {}; wavelengths {:a}", program_fingerprint(), options.seed,
                       options.rays, sample_key(sample, options.incidence_rad, &ParameterInfo::steers),
                       fmt::join(wavelengths_nm, " "));
}

PathEnsemble cached_ensemble(const Sample& sample, const std::vector<double>& wavelengths_nm,
                             const WalkOptions& options, const DiskCache& cache, const std::stop_token& stop) {
    require_memory(wavelengths_nm.size(), options.rays);
    const auto trace = [&] {
        cache.inform(fmt::format("recording {} walks at each of {} wavelengths", options.rays, wavelengths_nm.size()));
        return PathEnsemble::trace(sample, wavelengths_nm, options, stop);
    };
    const auto write = [&](const std::filesystem::path& path, std::string_view key, const PathEnsemble& ensemble) {
        write_ensemble_file(path, key, ensemble, stop);
    };
    if (!cache.folder) return trace();
    return cached<PathEnsemble>(cache, ensemble_key(sample, wavelengths_nm, options), "paths", trace,
                                read_ensemble_file, write);
}

}  // namespace skinfit
