#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "app/terminal.hpp"
#include "app/validate_by_transport.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"
#include "fit/gnuplot.hpp"
#include "study/transport_plan.hpp"
#include "validation/inverse_run.hpp"
#include "validation/inverse_summary.hpp"

namespace skinfit {
namespace {

struct ValidateInverseCommand {
    SharedOptions shared;
    std::filesystem::path output = "inverse_validation";
    std::optional<std::uint64_t> spectra;
    std::string seed;
    std::string engine;
    std::string simulate_by = "solver";
    std::string intervals;
    std::string cohort;
    std::optional<double> port_diameter_mm;
    std::vector<std::string> free;
    std::vector<std::string> fix;
};

Configuration configuration_of(const ValidateInverseCommand& command) {
    Configuration configuration = configuration_from(command.shared, study_configuration());
    const auto take = [&](const char* key, const std::string& text) {
        if (!text.empty()) configuration = configured_by_word(configuration, key, text, std::string("--") + key);
    };
    take("seed", command.seed);
    take("engine", command.engine);
    return with_free_and_fixed(configuration, command.free, command.fix);
}

/// The kinds of interval named in "profile,posterior".
std::array<bool, uncertainty_method_count> chosen_intervals(const std::string& names) {
    std::array<bool, uncertainty_method_count> chosen{};
    for (const std::string_view name : split(names, ',')) {
        const Configuration named =
            configured_by_word(default_configuration(), "uncertainty", name, fmt::format("--intervals {}", names));
        chosen[static_cast<std::size_t>(named.uncertainty)] = true;
    }
    return chosen;
}

void refuse_option(const std::string& option, const std::string& why, const std::string& remedy) {
    throw InputError({.where = option, .problem = "cannot be used here", .why = why, .remedy = remedy});
}

int run_by_transport(const ValidateInverseCommand& command, Session& session) {
    if (!command.intervals.empty()) {
        refuse_option("--intervals", "with --simulate-by transport each spectrum is fitted once",
                      "leave it out, or choose one kind by --set uncertainty=posterior");
    }
    return validate_by_transport({.shared = command.shared,
                                  .output = command.output,
                                  .cohort = command.cohort.empty() ? "natural" : command.cohort,
                                  .spectra = command.spectra,
                                  .port_diameter_mm = command.port_diameter_mm,
                                  .seed = command.seed,
                                  .engine = command.engine,
                                  .free = command.free,
                                  .fix = command.fix},
                                 session);
}

int run_by_model(const ValidateInverseCommand& command, Session& session) {
    const std::string by_model = "the engines of the model draw their skins from the priors and have no port";
    if (!command.cohort.empty()) refuse_option("--cohort", by_model, "add --simulate-by transport");
    if (command.port_diameter_mm) refuse_option("--port-diameter-mm", by_model, "add --simulate-by transport");
    const Configuration configuration = configuration_of(command);
    const Engine simulator =
        configured_by_word(default_configuration(), "engine", command.simulate_by, "--simulate-by").engine;
    RecoveryDesign design;
    design.spectra = command.spectra.value_or(design.spectra);
    design.intervals = chosen_intervals(command.intervals.empty() ? "covariance,profile,posterior" : command.intervals);
    check_freedom(configuration, "free");  // before a folder is made
    make_output_folder(command.output);
    require_gnuplot();
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "preparing the model");
    const RecoveryWatch watch{.stop = session.stop_on_interrupt("interrupted; the spectra at hand are finished first"),
                              .progress = [&](std::uint64_t done) {
                                  line.show({.what = fmt::format("{}/{} spectra", done, design.spectra),
                                             .done = done,
                                             .total = design.spectra,
                                             .count = done,
                                             .unit = "spectra"});
                              }};
    const InverseStudy study =
        run_inverse_study(configuration, simulator, design, cache_from(command.shared, line), watch);
    line.end();
    if (study.spectra.empty()) {
        line.tell("no spectrum was finished; nothing was written");
        return session.interrupt.exit_code();
    }
    const RecoverySummary summary = summarised(study.spectra, study.free);
    write_file_atomically(command.output / "recovery.csv", recovery_csv(study.spectra, study.free));
    Json json = recovery_json(summary);
    json["simulated_by"] = command.simulate_by;
    json["knows_model"] = true;
    json["configuration"] = to_json(configuration);
    const std::string text = json_text(json);
    write_file_atomically(command.output / "summary.json", text);
    command.shared.format == "json" ? write_stdout(text) : write_report_to_stdout(recovery_text(summary));
    const PlotSheet sheet = recovery_sheet(study.spectra, summary);
    for (const char* name : {"recovery.svg", "recovery.png"}) {
        write_beside(session, command.output / name, [&] { draw(sheet, command.output / name); });
    }
    if (study.spectra.size() < design.spectra) {
        line.tell(fmt::format("of {} spectra asked for only these {}", design.spectra, study.spectra.size()));
        return session.interrupt.exit_code();
    }
    return passes(summary) ? good_result : result_with_warning;
}

/// Which skins the transport takes, and through what.
void add_transport_options(CLI::App& inverse, ValidateInverseCommand& command) {
    inverse
        .add_option("--cohort", command.cohort,
                    "by transport: natural, factorial, or a cohort file as of study simulate; natural if not given")
        ->type_name("NAME|FILE");
    number(inverse.add_option("--port-diameter-mm", command.port_diameter_mm,
                              "by transport: of the disc that is lit and collected from; the cohort's if not given"),
           port_diameters_mm.lower, port_diameters_mm.upper, "mm");
}

}  // namespace

void add_validate_inverse_command(CLI::App& validate, Session& session) {
    const auto command = std::make_shared<ValidateInverseCommand>();
    const Configuration defaults = study_configuration();
    const Bounds melanosomes = defaults.bounds[static_cast<std::size_t>(Parameter::melanosome_fraction)];
    const Bounds blood = defaults.bounds[static_cast<std::size_t>(Parameter::papillary_blood_fraction)];
    CLI::App* const inverse = validate.add_subcommand(
        "inverse",
        fmt::format("fit synthetic spectra of known skin, and count how often intervals cover it; unless configured, "
                    "their noise is {}, and {} to {} of the epidermis are melanosomes, {} to {} of the dermis blood",
                    defaults.noise.value(), melanosomes.lower, melanosomes.upper, blood.lower, blood.upper));
    inverse
        ->add_option(
            "--output", command->output,
            "folder for recovery.csv, two pictures and summary.json; by transport transport.csv and summary.json")
        ->type_name("FOLDER")
        ->capture_default_str();
    whole_number(inverse->add_option("--spectra", command->spectra,
                                     "how many skins are drawn; 1000 from the priors, as many as the cohort has"),
                 1, 1'000'000);
    inverse->add_option("--seed", command->seed, "of skins, noise, starts and chains; 1 if not configured")
        ->type_name("N");
    inverse->add_option("--engine", command->engine, "of the fits; emulator if not configured")
        ->type_name("emulator|paths|solver");
    one_of(
        inverse->add_option(
            "--simulate-by", command->simulate_by,
            "what makes the spectra. Engines of the model: solver, emulator, walk, or paths, whose walks have another "
            "seed than the fits'. transport: another physics, a layered Monte Carlo of a cohort of skins, fitted by "
            "the preset skin"),
        {"solver", "emulator", "walk", "paths", "transport"})
        ->capture_default_str();
    add_transport_options(*inverse, *command);
    inverse
        ->add_option("--intervals", command->intervals,
                     "kinds of interval to compute; covariance,profile,posterior if not given")
        ->type_name("KIND,KIND");
    add_names_option(*inverse, "--free", command->free, "adjust these parameters too, beside those that are free");
    add_names_option(*inverse, "--fix", command->fix, "hold these parameters at their configured value");
    add_configuration_options(*inverse, command->shared, "priors=uniform");
    command->shared.format = "text";
    add_format_option(*inverse, command->shared.format, {"text", "json"}, "form of the summary on the terminal");
    add_threads_option(*inverse, command->shared.threads);
    add_no_cache_option(*inverse, command->shared.no_cache);
    add_examples(
        *inverse,
        {"skinfit validate inverse --spectra 20 --intervals covariance",
         "skinfit validate inverse --simulate-by transport --cohort factorial --output transport",
         "skinfit validate inverse --spectra 200 --intervals covariance,profile --set noise=0.006 --output recovery"},
        "Exit code 0: the study passes; 1: something failed; 2: bad input; 3: internal error; 130: ended by Ctrl-C.");
    inverse->callback([command, &session] {
        session.exit_code =
            command->simulate_by == "transport" ? run_by_transport(*command, session) : run_by_model(*command, session);
    });
}

}  // namespace skinfit
