#include "tests/fit/synthetic.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "model/spectrophotometer.hpp"

namespace skinfit::test {
namespace {

PathEnsemble traced(const Experiment& experiment, const std::vector<double>& wavelengths_nm,
                    const Configuration& configuration) {
    return PathEnsemble::trace(
        experiment.sample(), true_wavelengths_nm(experiment, wavelengths_nm),
        {.incidence_rad = experiment.incidence_rad, .rays = configuration.rays, .seed = configuration.seed});
}

}  // namespace

Configuration quick_configuration() {
    Configuration configuration = default_configuration();
    configuration.rays = 2000;
    return configuration;
}

Configuration with_free(Configuration configuration, const std::vector<Parameter>& free) {
    configuration.free.fill(false);
    for (const Parameter parameter : free) configuration.free[static_cast<std::size_t>(parameter)] = true;
    return configuration;
}

Configuration tilted(const Configuration& configuration, Engine engine, const std::vector<Parameter>& free) {
    Configuration changed = with_free(configuration, free);
    changed.engine = engine;
    changed.incidence_deg = 30;
    changed.specular = Specular::excluded;
    changed.quantity = Quantity::reflectance;
    changed.values.instrument = {.scale = 1.1, .offset = 0.01, .specular_fraction = 0.3};
    return changed;
}

Configuration inner_truth(double noise) {
    Configuration truth = quick_configuration();
    truth.values.skin.bilirubin_g_per_l = 1.0;
    truth.values.skin.papillary_blood_fraction = 0.03;
    truth.values.skin.oxygen_saturation = 0.6;
    truth.noise = noise;
    return truth;
}

std::vector<double> grid_nm(double first, double last, double step) {
    std::vector<double> grid;
    for (int i = 0; first + i * step <= last; ++i) grid.push_back(first + i * step);
    return grid;
}

Spectrum modelled_spectrum(const Configuration& truth, const std::vector<double>& wavelengths_nm) {
    const Experiment experiment = make_experiment(truth);
    const bool transmitted = truth.quantity == Quantity::transmittance;
    Spectrum spectrum{.name = "modelled",
                      .source = "modelled.csv",
                      .wavelength_nm = wavelengths_nm,
                      .value = {},
                      .sigma = {},
                      .quantity = truth.quantity,
                      .geometry = {},
                      .unit_rule = "fractions, as computed"};
    for (const Reading& reading :
         read_by_paths(experiment, wavelengths_nm, traced(experiment, wavelengths_nm, truth))) {
        spectrum.value.push_back(transmitted ? reading.transmittance : reading.reflectance);
    }
    return spectrum;
}

DiskCache no_cache() {
    return {.folder = std::nullopt, .warn = [](const std::string&) {}, .inform = [](const std::string&) {}};
}

Task::Task(const Configuration& configuration, const Spectrum& spectrum)
    : problem(make_problem(resolved(configuration, spectrum), spectrum)),
      objective(problem, traced(problem.only().experiment, problem.only().wavelength_nm, configuration)) {}

std::vector<double> normal_numbers(std::uint64_t seed, std::size_t count) {
    std::mt19937_64 bits(seed);
    const auto uniform = [&bits] { return (static_cast<double>(bits() >> 11U) + 0.5) * 0x1p-53; };
    std::vector<double> numbers;
    while (numbers.size() < count) {
        // Box and Muller's cosine.
        const double radius = std::sqrt(-2.0 * std::log(uniform()));
        numbers.push_back(radius * std::cos(2.0 * std::numbers::pi * uniform()));
    }
    return numbers;
}

}  // namespace skinfit::test
