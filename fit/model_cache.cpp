#include "fit/model_cache.hpp"

#include <fmt/format.h>

#include "fit/emulation.hpp"
#include "model/emulator_cache.hpp"

namespace skinfit {
namespace {

/// Everything that decides what the models of a problem are: what decides an emulator decides a walk too, but for its
/// rays and its seed.
std::string key_of(const FitProblem& problem, Engine engine) {
    std::string key = fmt::format("engine {};", static_cast<int>(engine));
    for (std::size_t k = 0; k < problem.measurements.size(); ++k) {
        const WalkOptions& walk = problem.measurements[k].walk;
        key += fmt::format(" rays {}; seed {}; {};", walk.rays, walk.seed, emulator_key(emulator_domain(problem, k)));
    }
    return key;
}

}  // namespace

std::vector<ForwardModel> ModelCache::models(const FitProblem& problem, Engine engine) {
    // Solvers cost next to nothing to make, and depend on more than the key holds.
    if (engine == Engine::solver) return make_models(problem, engine, cache_);
    const std::string key = key_of(problem, engine);
    std::shared_ptr<Place> place;
    {
        const std::lock_guard lock(mutex_);
        std::shared_ptr<Place>& stored = places_[key];
        if (!stored) stored = std::make_shared<Place>();
        place = stored;
    }
    const std::lock_guard lock(place->making);
    if (place->models.empty()) place->models = make_models(problem, engine, cache_);
    return place->models;
}

}  // namespace skinfit
