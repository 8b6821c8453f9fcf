#include <benchmark/benchmark.h>

#include "fit/bulk.hpp"
#include "fit/emulation.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {
namespace {

/// Table 1 at every 10 nm: 31 wavelengths, five free pigments.
FitProblem table_1(const Edition edition) {
    Configuration configuration = default_configuration();
    configuration.edition = edition;
    configuration.engine = Engine::emulator;
    Spectrum spectrum;
    for (double wavelength_nm = 400; wavelength_nm <= 700; wavelength_nm += 10) {
        spectrum.wavelength_nm.push_back(wavelength_nm);
    }
    const Experiment experiment = make_experiment(configuration);
    for (const Reading& reading : read_by_solver(experiment, spectrum.wavelength_nm)) {
        spectrum.value.push_back(reading.reflectance);
    }
    return make_problem(resolved(configuration, spectrum), spectrum);
}

void build_emulator(benchmark::State& state) {
    const EmulatorDomain domain = emulator_domain(table_1(static_cast<Edition>(state.range(0))));
    for (auto _ : state) benchmark::DoNotOptimize(Emulator::build(domain));
}
BENCHMARK(build_emulator)
    ->Arg(static_cast<int>(Edition::printed))
    ->Arg(static_cast<int>(Edition::revised))
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Shares and gradients of 31 wavelengths.
void respond(benchmark::State& state) {
    const FitProblem problem = table_1(Edition::revised);
    const Emulator emulator = Emulator::build(emulator_domain(problem));
    const std::vector<PerLayer<double>> depths = optical_depths(
        problem.only().experiment.values.skin, extinctions(problem.only().wavelength_nm, Edition::revised));
    for (auto _ : state) benchmark::DoNotOptimize(emulator.respond(depths));
    state.counters["certified_error"] = emulator.certified_error();
}
BENCHMARK(respond)->Unit(benchmark::kMicrosecond);

/// Spectra of different skins, with covariance.
void bulk(benchmark::State& state) {
    constexpr int count = 1000;
    const FitProblem problem = table_1(Edition::revised);
    const Emulator emulator = Emulator::build(emulator_domain(problem));
    Eigen::MatrixXd spectra(static_cast<Eigen::Index>(problem.only().wavelength_nm.size()), count);
    for (int i = 0; i < count; ++i) {
        Experiment experiment = problem.only().experiment;
        experiment.values.skin.melanosome_fraction = 0.005 + 0.0002 * i;
        experiment.values.skin.papillary_blood_fraction = 0.002 + 0.001 * (i % 50);
        Eigen::Index row = 0;
        for (const Reading& reading :
             read_by_emulator(experiment, problem.only().wavelength_nm, emulator, std::nullopt)) {
            spectra(row, i) =
                reading.reflectance + 0.002 * static_cast<double>((i * 31 + static_cast<int>(row) * 17) % 11 - 5);
            ++row;
        }
    }
    for (auto _ : state) benchmark::DoNotOptimize(fit_in_bulk(problem, emulator, spectra));
    state.counters["spectra_per_s"] = benchmark::Counter(
        static_cast<double>(count) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(bulk)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skinfit
