#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "app/transport_watch.hpp"
#include "core/file.hpp"
#include "core/stop.hpp"
#include "fit/configuration_json.hpp"
#include "fit/json_reading.hpp"
#include "study/cohort_folder.hpp"

namespace skinfit {
namespace {

struct StudySimulateCommand {
    std::string cohort;
    std::filesystem::path output;
    std::string engine;
    std::string seed;
    SharedOptions shared;
};

Cohort cohort_of(const StudySimulateCommand& command) {
    const std::string example = "configs/cohort_power.json, which comes with skinfit, is an example";
    Json json = parsed_json(read_input(command.cohort), command.cohort, example);
    require_object(json, command.cohort, example);
    if (!command.seed.empty()) {
        json["seed"] = configured_by_word(default_configuration(), "seed", command.seed, "--seed").seed;
    }
    Cohort cohort = read_cohort(json, command.cohort);
    if (command.engine.empty()) return cohort;
    json["model"]["engine"] = command.engine;
    return read_cohort(json, command.cohort);
}

std::string summary(const Cohort& cohort, const SimulatedCohort& simulated, const std::filesystem::path& folder) {
    const auto subjects = simulated.subjects.size();
    std::string text = fmt::format("{}: {} subjects, {} spectra at {} wavelengths\n", cohort.name, subjects,
                                   subjects * cohort.repeats, simulated.wavelength_nm.size());
    for (const CohortGroup& group : cohort.groups) text += fmt::format("  {:<24}{:>8}\n", group.name, group.subjects);
    for (const CohortLabel& label : cohort.labels) {
        const auto yes = std::ranges::count_if(
            simulated.subjects, [&](const SimulatedSubject& subject) { return label.holds(subject.values); });
        text += fmt::format("  {}: {} of {}\n", label.name, yes, subjects);
    }
    return text + fmt::format("written to {}: spectra.csv, manifest.csv, cohort.json, study.json\n", folder.string());
}

/// Nothing where Ctrl-C ended the layered transport, which takes minutes.
std::optional<SimulatedCohort> simulated_cohort(const Cohort& cohort, const StudySimulateCommand& command,
                                                Session& session, ProgressLine& line) {
    SimulationWatch watch;
    if (cohort.transport) watch = transport_watch(cohort, session, line);
    try {
        return simulate(cohort, cache_from(command.shared, line), watch);
    } catch (const Cancelled&) {
        line.end();
        line.tell("interrupted; nothing was written");
        return std::nullopt;
    }
}

int run(const StudySimulateCommand& command, Session& session) {
    const Cohort cohort = cohort_of(command);
    make_output_folder(command.output);
    const bool replaces = holds_earlier_cohort(command.output, command.cohort);
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "simulating");
    const std::optional<SimulatedCohort> simulated = simulated_cohort(cohort, command, session, line);
    if (!simulated) return session.interrupt.exit_code();
    write_cohort(cohort, *simulated, command.output);
    line.end();
    if (replaces) line.tell(fmt::format("note: replaced the earlier cohort in {}", command.output.string()));
    write_stdout(summary(cohort, *simulated, command.output));
    return good_result;
}

}  // namespace

void add_study_simulate_command(CLI::App& study, Session& session) {
    const auto command = std::make_shared<StudySimulateCommand>();
    CLI::App* const simulate = study.add_subcommand(
        "simulate", "draw subjects from stated populations and compute their spectra, to plan a study");
    simulate->add_option("COHORT", command->cohort, "JSON file: populations, groups, noise; see docs/studies.md")
        ->required();
    simulate->add_option("--output", command->output, "folder for spectra.csv, manifest.csv, cohort.json, study.json")
        ->type_name("FOLDER")
        ->required();
    one_of(simulate->add_option(
               "--engine", command->engine,
               "of the spectra: solver (no noise of its own), emulator or paths, instead of the cohort's"),
           {"solver", "emulator", "paths"});
    simulate->add_option("--seed", command->seed, "of everything drawn, instead of the cohort's")->type_name("N");
    add_threads_option(*simulate, command->shared.threads);
    add_no_cache_option(*simulate, command->shared.no_cache);
    add_examples(*simulate, {"skinfit study simulate configs/cohort_power.json --output cohort"});
    simulate->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
