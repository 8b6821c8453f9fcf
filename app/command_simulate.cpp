#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "fit/configuration_json.hpp"
#include "fit/emulation.hpp"
#include "fit/problem.hpp"
#include "fit/report.hpp"
#include "fit/viewing.hpp"
#include "fit/wavelength_sets.hpp"
#include "model/emulator_cache.hpp"
#include "model/ensemble_cache.hpp"

namespace skinfit {
namespace {

struct SimulateCommand {
    SharedOptions shared;
    std::string engine;
    std::string wavelengths;
    std::string rays;
    std::string seed;
};

Configuration simulate_configuration(const SimulateCommand& command) {
    Configuration configuration = configuration_from(command.shared);
    const auto take = [&](const char* key, const std::string& text) {
        if (!text.empty()) configuration = configured_by_word(configuration, key, text, std::string("--") + key);
    };
    take("engine", command.engine);
    take("wavelengths", command.wavelengths);
    take("rays", command.rays);
    take("seed", command.seed);
    return configuration;
}

/// By the analog walk, whose rays are the same at every wavelength.
std::vector<Reading> walked_readings(const Configuration& configuration, const Experiment& experiment,
                                     const std::vector<double>& wavelengths_nm, ProgressLine& line) {
    std::vector<Reading> readings;
    for (const double wavelength_nm : wavelengths_nm) {
        line.show({.what = "following rays", .done = readings.size(), .total = wavelengths_nm.size()});
        const std::vector<Reading> one =
            read_by_walk(experiment, {wavelength_nm}, configuration.rays, configuration.seed);
        readings.push_back(one.front());
    }
    return readings;
}

/// At single wavelengths.
std::vector<Reading> modelled_readings(const Configuration& configuration, const std::vector<double>& wavelengths_nm,
                                       const DiskCache& cache, ProgressLine& line) {
    const ResolvedConfiguration complete = resolved(configuration);
    check_viewing_cone(complete);
    const Experiment experiment = make_experiment(complete);
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, wavelengths_nm);
    (void)extinctions(true_nm, experiment.edition);  // refuses wavelengths outside the tables before any work
    if (configuration.engine == Engine::solver) return read_by_solver(experiment, wavelengths_nm);
    if (configuration.engine == Engine::emulator) {
        std::optional<Emulator> bottom;
        if (experiment.base.kind != Base::Kind::hypodermis) {
            bottom = cached_emulator(emulator_domain(configuration, Side::bottom, wavelengths_nm), cache);
        }
        return read_by_emulator(experiment, wavelengths_nm,
                                cached_emulator(emulator_domain(configuration, Side::top, wavelengths_nm), cache),
                                bottom);
    }
    if (configuration.engine == Engine::walk) {
        return walked_readings(configuration, experiment, wavelengths_nm, line);
    }
    return read_by_paths(
        experiment, wavelengths_nm,
        cached_ensemble(
            experiment.sample(), true_nm,
            {.incidence_rad = experiment.incidence_rad, .rays = configuration.rays, .seed = configuration.seed},
            cache));
}

std::vector<Reading> readings(const Configuration& configuration, const DiskCache& cache, ProgressLine& line) {
    const std::vector<double> centres_nm = parse_wavelengths(configuration.wavelengths, "wavelengths");
    const BandSampling bands = sample_bands(centres_nm, bandpass_of(resolved(configuration)));
    return readings_in_bands(modelled_readings(configuration, bands.wavelength_nm, cache, line), bands, centres_nm);
}

int run(const SimulateCommand& command, Session& session) {
    const Configuration configuration = simulate_configuration(command);
    check_output(command.shared);
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "computing the spectrum");
    const std::vector<Reading> spectrum = readings(configuration, cache_from(command.shared, line), line);
    line.end();
    write_output(command.shared, command.shared.format == "json" ? json_text(simulation_json(spectrum, configuration))
                                                                 : simulation_csv(spectrum, configuration));
    return good_result;
}

}  // namespace

void add_simulate_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<SimulateCommand>();
    CLI::App* const simulate = app.add_subcommand("simulate", "compute the spectrum of a described skin");
    simulate
        ->add_option(
            "--engine", command->engine,
            "how the model is computed: by recorded walks of light, the walk of the paper ray by ray, a solver without "
            "random noise, or its stand-in for one geometry, the emulator" +
                unless_configured("engine"))
        ->type_name(choices(engine_names));
    add_wavelengths_option(*simulate, command->wavelengths);
    simulate->add_option("--rays", command->rays, "per wavelength" + unless_configured("rays"))->type_name("N");
    simulate->add_option("--seed", command->seed, "of the random numbers" + unless_configured("seed"))->type_name("N");
    add_shared_options(*simulate, command->shared, {"csv", "json"});
    add_examples(*simulate,
                 {"skinfit simulate", "skinfit simulate --engine solver --wavelengths 400:700:5 --out skin.csv",
                  "skinfit simulate --set melanosome_fraction=0.25 --set oxygen_saturation=0.6 --format json"});
    simulate->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
