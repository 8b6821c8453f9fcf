#include <fmt/format.h>
#include <sched.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "app/study_options.hpp"
#include "app/terminal.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "study/study_processes.hpp"

namespace skinfit {
namespace {

struct StudyRunCommand {
    StudyOptions shared;
    std::string part;
    std::vector<std::string> parts;
    int threads = 0;
    bool no_cache = false;
    bool verbose = false;
};

/// The share named in "2/10".
StudyPart part_of(const StudyRunCommand& command) {
    const std::vector<std::string_view> halves = split(command.part, '/');
    const auto number = parse_count(halves.front());
    const auto parts = parse_count(halves.back());
    if (halves.size() == 2 && number && parts && *number >= 1 && *number <= *parts) {
        return {.number = *number, .parts = *parts};
    }
    throw InputError({.where = fmt::format("--part {}", command.part),
                      .problem = "is no share of a study",
                      .why = "it must be the number of a part, from 1, and how many there are",
                      .remedy = "write it as in --part 2/10"});
}

/// The ledger of a part must not be that of the whole: the parts would drop each other's spectra.
void check_part(const StudyRunCommand& command) {
    if (command.part.empty()) return;
    (void)part_of(command);
    if (!command.shared.ledger.empty()) return;
    throw InputError(
        {.where = fmt::format("--part {}", command.part),
         .problem = "has no ledger of its own",
         .why = "parts that run at the same time cannot write one ledger",
         .remedy = "add --ledger FILE, another one for each part, and merge them with `skinfit study merge`"});
}

/// Of this process, which a launcher may have bound to some of the machine's.
int usable_processors() {
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof set, &set) != 0) return 1;
    return std::max(1, CPU_COUNT(&set));
}

/// What the log of a batch job gets.
ProgressLine::Log log_of(const StudyRunCommand& command) {
    return command.verbose ? ProgressLine::Log::often : ProgressLine::Log::now_and_then;
}

Progress shown(const StudyProgress& progress) {
    constexpr std::uint64_t pixels_per_spectrum = 20;  // in time, about
    std::string what;
    if (progress.spectra_to_do > 0) what = fmt::format("{}/{} spectra", progress.spectra, progress.spectra_to_do);
    if (progress.pixels_to_do > 0) {
        what += fmt::format("{}{}/{} pixels", what.empty() ? "" : ", ", progress.pixels, progress.pixels_to_do);
    }
    return {.what = what,
            .done = progress.spectra * pixels_per_spectrum + progress.pixels,
            .total = progress.spectra_to_do * pixels_per_spectrum + progress.pixels_to_do,
            .count = progress.spectra + progress.pixels,
            .unit = progress.pixels_to_do == 0 ? "spectra" : (progress.spectra_to_do == 0 ? "pixels" : "fits")};
}

StudyRunOptions options_of(const StudyRunCommand& command, const Study& study, ProgressLine& line) {
    SharedOptions cache;
    cache.no_cache = command.no_cache;
    StudyRunOptions options;
    options.jobs = command.threads > 0 ? command.threads : usable_processors();
    options.cache = cache_from(cache, line);
    if (!command.part.empty()) options.part = part_of(command);
    options.ledger = ledger_of(command.shared, study);
    options.progress = [&line](const StudyProgress& progress) { line.show(shown(progress)); };
    options.tell = [&line](const std::string& text) { line.tell(text); };
    return options;
}

int finished(const StudyRunCommand& command, const Study& study, const StudyRun& run, const Session& session) {
    const Ledger ledger(ledger_of(command.shared, study), Ledger::Access::read);
    const StudyCounts counts = counts_of(ledger);
    if (!session.quiet) {
        if (run.left_out > 0)
            say_line(fmt::format("{} spectra left out: their names are not the study's", run.left_out));
        if (run.stopped) say_line("stopped; run it again to go on");
        write_stdout(status_text(counts));
        write_stdout(fmt::format("ledger: {}\n", ledger.path().string()));
    }
    return std::max<int>(exit_code_of(counts), run.undrawn_maps > 0 ? result_with_warning : good_result);
}

/// One file that is missing is a failure among others; where all are, the folder is the wrong one.
void check_inputs(const Study& study) {
    std::error_code error;
    const auto is_missing = [&error](const StudyFile& file) { return !std::filesystem::exists(file.path, error); };
    if (!study.cubes.empty() || study.files.empty() || !std::ranges::all_of(study.files, is_missing)) return;
    throw InputError({.where = study.file.string() + ".inputs",
                      .problem = "none of the files is there",
                      .why = fmt::format("the first would be {}", study.files.front().path.string()),
                      .remedy = "correct their names, or name their folder with --data"});
}

int run_it(const StudyRunCommand& command, Session& session) {
    check_part(command);
    const Study study = study_of(command.shared);
    check_inputs(study);
    ProgressLine line(session, "planning", log_of(command));
    StudyRunOptions options = options_of(command, study, line);
    const std::stop_token stop =
        session.stop_on_interrupt("interrupted; what has begun is stored first, Ctrl-C again ends at once");
    options.stop = [&stop] { return stop.stop_requested(); };
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.jobs));
    const std::optional<StudyRun> run = run_study_together(study, options);
    if (!run) return good_result;  // the process that leads says the rest
    line.end();
    const int exit_code = finished(command, study, *run, session);
    // Launchers take any other code of one process for a failure of all.
    if (launched_processes() > 1) return good_result;
    return run->stopped ? session.interrupt.exit_code() : exit_code;
}

int merge_it(const StudyRunCommand& command, Session& session) {
    const Study study = study_of(command.shared);
    ProgressLine line(session, "merging", log_of(command));
    StudyRunOptions options = options_of(command, study, line);
    options.stop = [] { return false; };
    const StudyRun run = merge_study(study, {command.parts.begin(), command.parts.end()}, options);
    line.end();
    return finished(command, study, run, session);
}

void add_run_options(CLI::App& sub, const std::shared_ptr<StudyRunCommand>& command, Session& session) {
    add_threads_option(sub, command->threads);
    // The name that --threads had here; it works and is not shown.
    whole_number(sub.add_option("--jobs", command->threads, "as --threads"), 1, 1024)->group("");
    add_no_cache_option(sub, command->no_cache);
    CLI::Option* const quiet = add_quiet_option(sub, session);
    sub.add_flag("--verbose", command->verbose, "say more often how far it is")->excludes(quiet);
}

}  // namespace

void add_study_run_command(CLI::App& study, Session& session) {
    const auto run = std::make_shared<StudyRunCommand>();
    CLI::App* const run_app =
        add_study_subcommand(study, run->shared, "run", "fit whatever has not been fitted; go on where it ended");
    run_app->add_option("--part", run->part, "only this share of the study, as in 2/10")->type_name("K/N");
    add_run_options(*run_app, run, session);
    add_examples(
        *run_app,
        {"skinfit study run configs/study_example.json",
         "skinfit study run configs/study_example.json --part 1/2 --ledger part_1.sqlite"},
        "Exit code 0: every spectrum is fitted; 1: some are suspect, rejected, failed or pending; 2: bad input; 3: "
        "internal error; 130: ended by Ctrl-C, to go on with later. Under mpirun 0 stands for 1 and 130 too.");
    run_app->callback([run, &session] { session.exit_code = run_it(*run, session); });
}

void add_study_merge_command(CLI::App& study, Session& session) {
    const auto merge = std::make_shared<StudyRunCommand>();
    CLI::App* const merge_app =
        add_study_subcommand(study, merge->shared, "merge", "bring the ledgers of parts together");
    merge_app->add_option("LEDGER", merge->parts, "ledgers of parts, from `skinfit study run --part`")->required();
    add_run_options(*merge_app, merge, session);
    add_examples(
        *merge_app, {"skinfit study merge configs/study_example.json part_1.sqlite"},
        "Exit code 0: every spectrum is fitted; 1: some are suspect, rejected, failed or pending; 2: bad input; "
        "3: internal error.");
    merge_app->callback([merge, &session] { session.exit_code = merge_it(*merge, session); });
}

}  // namespace skinfit
