#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <filesystem>

#include "fit/fit.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {
namespace {

/// NCSU 113 at every 10 nm: 31 wavelengths, five free pigments, 100 000 rays.
Spectrum specimen() {
    Spectrum every_5_nm =
        read_spectrum(std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements" / "data" / "ncsu_113.csv");
    Spectrum thinned = every_5_nm;
    thinned.wavelength_nm.clear();
    thinned.value.clear();
    for (std::size_t i = 0; i < every_5_nm.wavelength_nm.size(); i += 2) {
        thinned.wavelength_nm.push_back(every_5_nm.wavelength_nm[i]);
        thinned.value.push_back(every_5_nm.value[i]);
    }
    return thinned;
}

FitOptions options(const std::filesystem::path& folder) {
    return {.cross_check = false,
            .cache = {.folder = folder, .warn = [](const std::string&) {}, .inform = [](const std::string&) {}}};
}

double peak_memory_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Nothing in the cache: the walks are recorded and kept, then fitted.
void cold_fit(benchmark::State& state) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "skinfit_benchmark_cold";
    const Spectrum spectrum = specimen();
    for (auto _ : state) {
        std::filesystem::remove_all(folder);
        benchmark::DoNotOptimize(fit_spectrum(default_configuration(), spectrum, options(folder)));
    }
    std::filesystem::remove_all(folder);
    state.counters["peak_memory_mb"] = peak_memory_mb();
}
BENCHMARK(cold_fit)->UseRealTime()->Unit(benchmark::kMillisecond);

/// The recorded walks come from the cache.
void warm_fit(benchmark::State& state) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "skinfit_benchmark_warm";
    const Spectrum spectrum = specimen();
    const FitOptions keep = options(folder);
    benchmark::DoNotOptimize(fit_spectrum(default_configuration(), spectrum, keep));
    for (auto _ : state) benchmark::DoNotOptimize(fit_spectrum(default_configuration(), spectrum, keep));
    std::filesystem::remove_all(folder);
    state.counters["peak_memory_mb"] = peak_memory_mb();
}
BENCHMARK(warm_fit)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skinfit
