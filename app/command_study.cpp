#include <algorithm>
#include <atomic>
#include <csignal>

#include <fmt/format.h>
#include <sched.h>

#include "app/commands.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "study/study_output.hpp"
#include "study/study_processes.hpp"
#include "study/study_report.hpp"
#include "study/study_run.hpp"

namespace skinfit {
namespace {

/// What the subcommands have in common.
struct StudyCommand {
    std::string study;
    std::string ledger;
    std::string part;
    int jobs = 0;
    bool no_cache = false;
    bool quiet = false;
    bool verbose = false;
    std::string format;
    std::filesystem::path out;
    std::vector<std::string> parts;
};

std::filesystem::path ledger_of(const StudyCommand& command, const Study& study) {
    return command.ledger.empty() ? ledger_path(study) : std::filesystem::path(command.ledger);
}

/// The share named in "2/10".
StudyPart part_of(const StudyCommand& command) {
    if (command.part.empty()) return {};
    const std::vector<std::string_view> halves = split(command.part, '/');
    const auto number = parse_count(halves.front());
    const auto parts = parse_count(halves.back());
    if (halves.size() == 2 && number && parts && *number >= 1 && *number <= *parts) {
        return {.number = *number, .parts = *parts};
    }
    throw InputError({.where = fmt::format("--part {}", command.part),
                      .problem = "is no share",
                      .why = "it must be the number of a part, from 1, and how many there are",
                      .remedy = "write it as in --part 2/10"});
}

/// The ledger of a part must not be that of the whole: the parts would drop each other's spectra.
void check_part(const StudyCommand& command) {
    if (command.part.empty() || !command.ledger.empty()) return;
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

std::atomic<bool> interrupted = false;

/// The first Ctrl-C ends the run when what has begun is stored; the second one at once.
void end_on_interrupt() {
    std::signal(SIGINT, [](int) {
        interrupted = true;
        std::signal(SIGINT, SIG_DFL);
    });
}

StudyRunOptions options_of(const StudyCommand& command, const Study& study, ProgressLine& line) {
    SharedOptions shared;
    shared.no_cache = command.no_cache;
    StudyRunOptions options;
    options.jobs = command.jobs > 0 ? command.jobs : usable_processors();
    options.cache = cache_from(shared);
    options.part = part_of(command);
    options.ledger = ledger_of(command, study);
    options.progress = [&line](const StudyProgress& progress) {
        // A pixel costs a hundredth of a spectrum or less.
        constexpr std::uint64_t pixels_per_spectrum = 100;
        line.show({.done = progress.spectra * pixels_per_spectrum + progress.pixels,
                   .total = progress.spectra_to_do * pixels_per_spectrum + progress.pixels_to_do,
                   .what = progress.pixels_to_do == 0
                               ? fmt::format("{}/{} spectra", progress.spectra, progress.spectra_to_do)
                               : fmt::format("{}/{} spectra, {}/{} pixels", progress.spectra, progress.spectra_to_do,
                                             progress.pixels, progress.pixels_to_do),
                   .count = progress.spectra + progress.pixels,
                   .unit = progress.pixels_to_do == 0 ? "spectra" : "fits"});
    };
    options.tell = [&line](const std::string& text) { line.tell(text); };
    options.stop = [] { return interrupted.load(); };
    return options;
}

int exit_code_of(const StudyCounts& counts) {
    const auto count = [](const StatusCounts& each, FitStatus status) {
        return each[static_cast<std::size_t>(status)];
    };
    for (const FitStatus status : {FitStatus::pending, FitStatus::suspect, FitStatus::rejected, FitStatus::failed}) {
        if (count(counts.spectra, status) > 0 || count(counts.pixels, status) > 0) return result_with_warning;
    }
    return counts.unread_cubes.empty() ? trustworthy_result : result_with_warning;
}

int finished(const StudyCommand& command, const Study& study, const StudyRun& run) {
    const Ledger ledger(ledger_of(command, study), Ledger::Access::read);
    const StudyCounts counts = counts_of(ledger);
    if (!command.quiet) {
        if (run.left_out > 0)
            fmt::print(stderr, "{} spectra left out: their names are not the study's\n", run.left_out);
        if (run.stopped) fmt::print(stderr, "stopped; run it again to go on\n");
        write_stdout(status_text(counts));
        write_stdout(fmt::format("ledger: {}\n", ledger.path().string()));
    }
    return exit_code_of(counts);
}

int run_it(const StudyCommand& command) {
    check_part(command);
    const Study study = read_study(command.study);
    ProgressLine line({.quiet = command.quiet, .verbose = command.verbose});
    const StudyRunOptions options = options_of(command, study, line);
    end_on_interrupt();
    const std::optional<StudyRun> run = run_study_together(study, options);
    if (!run) return trustworthy_result;  // the process that leads says the rest
    line.end();
    const int exit_code = finished(command, study, *run);
    // Launchers take any other code of one process for a failure of all.
    return launched_processes() == 1 ? exit_code : trustworthy_result;
}

int merge_it(const StudyCommand& command) {
    const Study study = read_study(command.study);
    ProgressLine line({.quiet = command.quiet, .verbose = command.verbose});
    const StudyRunOptions options = options_of(command, study, line);
    return finished(command, study, merge_study(study, {command.parts.begin(), command.parts.end()}, options));
}

int status_it(const StudyCommand& command) {
    const Study study = read_study(command.study);
    const StudyCounts counts = counts_of(Ledger(ledger_of(command, study), Ledger::Access::read));
    write_stdout(command.format == "json" ? json_text(status_json(counts)) : status_text(counts));
    return exit_code_of(counts);
}

int export_it(const StudyCommand& command) {
    const Study study = read_study(command.study);
    SharedOptions shared;
    shared.out = command.out;
    std::vector<std::filesystem::path> inputs = {command.study, ledger_of(command, study)};
    for (const StudyFile& file : study.files) inputs.push_back(file.path);
    check_output(shared, inputs);
    const Ledger ledger(ledger_of(command, study), Ledger::Access::read);
    const std::vector<AnsweredRow> rows = answered(study, ledger.rows());
    write_output(shared,
                 command.format == "json" ? json_text(study_json(study, ledger, rows)) : study_csv(study, rows));
    return trustworthy_result;
}

int report_it(const StudyCommand& command) {
    const Study study = read_study(command.study);
    const Ledger ledger(ledger_of(command, study), Ledger::Access::read);
    SharedOptions shared;
    shared.out = command.out.empty() ? study.output / "report.html" : command.out;
    check_output(shared, {command.study, ledger.path()});
    write_output(shared, study_page(study, results_of(study, ledger)));
    fmt::print(stderr, "wrote {}\n", shared.out.string());
    return trustworthy_result;
}

CLI::App* add(CLI::App& study, const std::shared_ptr<StudyCommand>& command, const char* name, const char* meaning) {
    CLI::App* const sub = study.add_subcommand(name, meaning);
    sub->add_option("STUDY", command->study, "JSON file that describes the study")->required();
    sub->add_option("--ledger", command->ledger, "keep the results there instead of in the study's output folder")
        ->type_name("FILE");
    return sub;
}

void add_run_options(CLI::App& sub, const std::shared_ptr<StudyCommand>& command) {
    sub.add_option("--jobs", command->jobs, "threads; as many as the machine has by default")
        ->check(CLI::Range(1, 1024));
    sub.add_flag("--no-cache", command->no_cache, "do not keep or use recorded walks");
    auto* const quiet = sub.add_flag("--quiet", command->quiet, "print nothing but errors");
    sub.add_flag("--verbose", command->verbose, "say more often how far it is")->excludes(quiet);
}

void add_formats(CLI::App& sub, const std::shared_ptr<StudyCommand>& command, const std::vector<std::string>& formats) {
    command->format = formats.front();
    sub.add_option("--format", command->format, "form of the output")
        ->check(CLI::IsMember(formats))
        ->capture_default_str();
}

}  // namespace

void add_study_command(CLI::App& app, int& exit_code) {
    CLI::App* const study = app.add_subcommand("study", "fit thousands of spectra and whole images by one file");
    study->require_subcommand(1);
    const auto run = std::make_shared<StudyCommand>();
    CLI::App* const run_app = add(*study, run, "run", "fit whatever has not been fitted; go on where it ended");
    run_app->add_option("--part", run->part, "only this share of the study, as in 2/10")->type_name("K/N");
    add_run_options(*run_app, run);
    run_app->footer(
        "Exit code 0: every spectrum is fitted; 1: some are suspect, rejected, failed or pending; 2: bad input; 3: "
        "internal error. Under mpirun 0 stands for 1 too.");
    run_app->callback([run, &exit_code] { exit_code = run_it(*run); });

    const auto status = std::make_shared<StudyCommand>();
    CLI::App* const status_app = add(*study, status, "status", "count fitted, suspect, rejected, failed and pending");
    add_formats(*status_app, status, {"text", "json"});
    status_app->callback([status, &exit_code] { exit_code = status_it(*status); });

    const auto exported = std::make_shared<StudyCommand>();
    CLI::App* const export_app = add(*study, exported, "export", "write the results as a table or as JSON");
    add_formats(*export_app, exported, {"csv", "json"});
    export_app->add_option("--out", exported->out, "write there instead of to the terminal")->type_name("FILE");
    export_app->callback([exported, &exit_code] { exit_code = export_it(*exported); });

    const auto report = std::make_shared<StudyCommand>();
    CLI::App* const report_app = add(*study, report, "report", "write a page with tables and plots");
    report_app->add_option("--out", report->out, "write there instead of to report.html in the output folder")
        ->type_name("FILE");
    report_app->callback([report, &exit_code] { exit_code = report_it(*report); });

    const auto merge = std::make_shared<StudyCommand>();
    CLI::App* const merge_app = add(*study, merge, "merge", "bring the ledgers of parts together");
    merge_app->add_option("LEDGER", merge->parts, "ledgers of parts, from `skinfit study run --part`")->required();
    add_run_options(*merge_app, merge);
    merge_app->callback([merge, &exit_code] { exit_code = merge_it(*merge); });
}

}  // namespace skinfit
