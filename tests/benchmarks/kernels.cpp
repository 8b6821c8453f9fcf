#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>

#include "model/chromophores.hpp"
#include "model/constants.hpp"
#include "model/path_ensemble.hpp"
#include "model/random_walk.hpp"

namespace skinfit {
namespace {

constexpr WalkOptions options{.incidence_rad = 45 * rad_per_deg, .rays = 100'000, .seed = 1};

std::vector<double> visible_nm() {
    std::vector<double> wavelengths_nm;
    for (int i = 0; i <= 30; ++i) wavelengths_nm.push_back(400 + 10 * i);
    return wavelengths_nm;
}

/// The mean square over the wavelengths of the standard error of 100 000 recorded rays.
double recorded_variance(const std::vector<double>& wavelengths_nm) {
    const Sample sample;
    std::vector<PerLayer<double>> depths;
    for (const double wavelength_nm : wavelengths_nm) {
        depths.push_back(optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition)));
    }
    double sum = 0.0;
    for (const EnsembleResponse& response : PathEnsemble::trace(sample, wavelengths_nm, options).respond(depths)) {
        sum += response[Side::top].standard_error * response[Side::top].standard_error;
    }
    return sum / static_cast<double>(wavelengths_nm.size());
}

/// Recorded rays per second and core, Table 1; standard error of 100 000, and its square times the time they take.
void record_walks(benchmark::State& state) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
    const std::vector<double> wavelengths_nm = {450, 540, 660};
    for (auto _ : state) benchmark::DoNotOptimize(PathEnsemble::trace(Sample{}, wavelengths_nm, options));
    const double variance = recorded_variance(wavelengths_nm);
    state.counters["standard_error"] = std::sqrt(variance);
    state.counters["variance_times_s"] =
        benchmark::Counter(static_cast<double>(wavelengths_nm.size()) * static_cast<double>(state.iterations()) /
                               (static_cast<double>(state.range(0)) * variance),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    const auto rays = static_cast<double>(3 * options.rays) * static_cast<double>(state.iterations());
    state.counters["rays_per_s_and_core"] =
        benchmark::Counter(rays / static_cast<double>(state.range(0)), benchmark::Counter::kIsRate);
}
BENCHMARK(record_walks)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Analog rays per second and core, Table 1.
void walk_rays(benchmark::State& state) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(random_walk(Sample{}, {450, 540, 660}, options));
    const auto rays = static_cast<double>(3 * options.rays) * static_cast<double>(state.iterations());
    state.counters["rays_per_s_and_core"] =
        benchmark::Counter(rays / static_cast<double>(state.range(0)), benchmark::Counter::kIsRate);
}
BENCHMARK(walk_rays)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// 31 wavelengths x 100 000 rays with the derivatives by all four optical depths.
void respond(benchmark::State& state) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
    const Sample sample;
    const PathEnsemble ensemble = PathEnsemble::trace(sample, visible_nm(), options);
    std::vector<PerLayer<double>> depths;
    for (const double wavelength_nm : visible_nm()) {
        depths.push_back(optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition)));
    }
    for (auto _ : state) benchmark::DoNotOptimize(ensemble.respond(depths));
}
BENCHMARK(respond)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skinfit
