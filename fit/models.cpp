#include "fit/models.hpp"

#include <stdexcept>

#include "fit/emulation.hpp"
#include "model/emulator_cache.hpp"
#include "model/ensemble_cache.hpp"

namespace skinfit {

namespace {

ForwardModel emulator_of(const EmulatorDomain& domain, const DiskCache& cache, const std::stop_token& stop) {
    if (!varies_fibril_radius(domain)) return cached_emulator(domain, cache, stop);
    return RadiusEmulator(domain, [&](const EmulatorDomain& of_one) { return cached_emulator(of_one, cache, stop); });
}

}  // namespace

std::vector<ForwardModel> make_models(const FitProblem& problem, Engine engine, const DiskCache& cache,
                                      const std::stop_token& stop) {
    std::vector<ForwardModel> models;
    for (std::size_t k = 0; k < problem.measurements.size(); ++k) {
        const Measurement& measurement = problem.measurements[k];
        const Experiment& experiment = measurement.experiment;
        switch (engine) {
            case Engine::paths:
                models.emplace_back(cached_ensemble(experiment.sample(),
                                                    true_wavelengths_nm(experiment, measurement.bands.wavelength_nm),
                                                    measurement.walk, cache, stop));
                break;
            case Engine::solver:
                models.emplace_back(angular_solver(experiment));
                break;
            case Engine::emulator:
                models.push_back(emulator_of(emulator_domain(problem, k), cache, stop));
                break;
            case Engine::walk:
                throw std::logic_error("the analog walk is no model of a fit");
        }
    }
    return models;
}

std::vector<ForwardModel> cheap_models(const FitProblem& problem, const std::vector<ForwardModel>& models) {
    constexpr std::uint64_t few_rays = 3000;
    std::vector<ForwardModel> cheap;
    for (std::size_t k = 0; k < models.size(); ++k) {
        if (const auto* const ensemble = std::get_if<PathEnsemble>(&models[k])) {
            cheap.emplace_back(ensemble->with_about(few_rays));
        } else if (certified_error(models[k])) {
            cheap.push_back(models[k]);
        } else {
            cheap.emplace_back(
                angular_solver(problem.measurements[k].experiment, AngularResolution::for_accuracy(1e-3)));
        }
    }
    return cheap;
}

}  // namespace skinfit
