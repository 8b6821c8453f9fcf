#include "fit/model_cache.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "fit/objective.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

Configuration base(Engine engine) {
    Configuration configuration =
        with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction});
    configuration.engine = engine;
    configuration.incidence_deg = 8;
    configuration.specular = Specular::included;
    configuration.quantity = Quantity::reflectance;
    configuration.rays = 300;
    return configuration;
}

Spectrum example() {
    Spectrum spectrum;
    spectrum.name = spectrum.source = "example";
    spectrum.wavelength_nm = grid_nm(500, 600, 10);
    for (const double nm : spectrum.wavelength_nm) spectrum.value.push_back(0.3 + 0.001 * (nm - 500.0));
    return spectrum;
}

FitProblem problem_of(const Configuration& configuration, const Spectrum& spectrum) {
    return make_problem(resolved(configuration, spectrum), spectrum);
}

/// The same models read the same, to the last bit.
bool read_the_same(const FitProblem& problem, const std::vector<ForwardModel>& a, const std::vector<ForwardModel>& b) {
    std::vector<double> values;
    for (const FreeParameter& free : problem.free) values.push_back(free.start);
    const Misfit one = Objective(problem, a).misfit(values);
    const Misfit other = Objective(problem, b).misfit(values);
    return one.residual == other.residual && one.jacobian == other.jacobian;
}

/// Whatever a problem asks for, the cache gives what `make_models` makes, also after it has served other problems.
TEST(ModelCache, GivesTheModelsOfTheProblem) {
    using Change = std::function<void(Configuration&, Spectrum&)>;
    const std::vector<Change> changes = {
        [](Configuration&, Spectrum&) {},
        [](Configuration& c, Spectrum&) { c.incidence_deg = 45; },
        [](Configuration& c, Spectrum&) { c.seed = 2; },
        [](Configuration& c, Spectrum&) { c.rays = 400; },
        [](Configuration& c, Spectrum&) { c.values.skin.fold_aspect_ratio = 0.3; },
        [](Configuration& c, Spectrum&) { c.values.instrument.wavelength_shift_nm = 3; },
        [](Configuration& c, Spectrum&) { c.edition = Edition::printed; },
        [](Configuration& c, Spectrum&) { c.base = Base{.kind = Base::Kind::matched}; },
        [](Configuration&, Spectrum& s) { s.wavelength_nm.back() = 605; },
        [](Configuration&, Spectrum& s) { s.value.back() = 0.35; }};
    for (const Engine engine : {Engine::paths, Engine::solver}) {
        ModelCache cache(no_cache());
        for (int round = 0; round < 2; ++round) {
            for (std::size_t i = 0; i < changes.size(); ++i) {
                Configuration configuration = base(engine);
                Spectrum spectrum = example();
                changes[i](configuration, spectrum);
                const FitProblem problem = problem_of(configuration, spectrum);
                EXPECT_TRUE(
                    read_the_same(problem, cache.models(problem, engine), make_models(problem, engine, no_cache())))
                    << "change " << i << ", round " << round;
            }
        }
    }
}

TEST(ModelCache, GivesTheEmulatorOfTheProblem) {
    ModelCache cache(no_cache());
    for (const double incidence_deg : {8.0, 45.0, 8.0}) {
        Configuration configuration = base(Engine::emulator);
        configuration.incidence_deg = incidence_deg;
        const FitProblem problem = problem_of(configuration, example());
        EXPECT_TRUE(read_the_same(problem, cache.models(problem, Engine::emulator),
                                  make_models(problem, Engine::emulator, no_cache())));
    }
}

/// The comparison can fail: walks of another seed read differently.
TEST(ModelCache, OtherWalksReadDifferently) {
    Configuration configuration = base(Engine::paths);
    const FitProblem problem = problem_of(configuration, example());
    configuration.seed = 2;
    const FitProblem other = problem_of(configuration, example());
    EXPECT_FALSE(read_the_same(problem, make_models(problem, Engine::paths, no_cache()),
                               make_models(other, Engine::paths, no_cache())));
}

/// Of ten requests at once, in two kinds, each gets its own.
TEST(ModelCache, ServesThreadsAtOnce) {
    Configuration configuration = base(Engine::paths);
    const FitProblem one = problem_of(configuration, example());
    configuration.incidence_deg = 45;
    const FitProblem other = problem_of(configuration, example());
    ModelCache cache(no_cache());
    std::vector<std::vector<ForwardModel>> given(10);
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < given.size(); ++i) {
            threads.emplace_back([&, i] { given[i] = cache.models(i % 2 == 0 ? one : other, Engine::paths); });
        }
    }
    for (std::size_t i = 0; i < given.size(); ++i) {
        EXPECT_TRUE(read_the_same(i % 2 == 0 ? one : other, given[i],
                                  make_models(i % 2 == 0 ? one : other, Engine::paths, no_cache())));
    }
}

}  // namespace
}  // namespace skinfit::test
