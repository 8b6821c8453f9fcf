#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "app/study_options.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/gnuplot.hpp"
#include "study/study_csv.hpp"
#include "study/study_power.hpp"
#include "study/study_report.hpp"

namespace skinfit {
namespace {

struct StudyResultCommand {
    StudyOptions shared;
    std::filesystem::path out;
    std::string quantity;
    std::string subjects = "5,10,20,50,100,200";
    double power = 0.8;
    std::size_t repeats = 1;
    std::filesystem::path plot;
};

int status_it(const StudyResultCommand& command, Session& /*session*/) {
    const Study study = study_of(command.shared);
    const StudyCounts counts = counts_of(Ledger(ledger_of(command.shared, study), Ledger::Access::read));
    write_stdout(command.shared.format == "json" ? json_text(status_json(counts)) : status_text(counts));
    return exit_code_of(counts);
}

int export_it(const StudyResultCommand& command, Session& session) {
    const Study study = study_of(command.shared);
    SharedOptions output;
    output.out = command.out;
    std::vector<std::filesystem::path> inputs = {command.shared.study, ledger_of(command.shared, study)};
    for (const StudyFile& file : study.files) inputs.push_back(file.path);
    check_output(output, inputs);
    const Ledger ledger(ledger_of(command.shared, study), Ledger::Access::read);
    ProgressLine line(session, "reading the ledger");
    const std::vector<AnsweredRow> rows = answered(study, ledger.rows());
    const std::string text =
        command.shared.format == "json" ? json_text(results_json(study, ledger, rows)) : study_csv(study, rows);
    line.end();
    write_output(output, text);
    return good_result;
}

int report_it(const StudyResultCommand& command, Session& session) {
    const Study study = study_of(command.shared);
    const Ledger ledger(ledger_of(command.shared, study), Ledger::Access::read);
    SharedOptions output;
    output.out = command.out.empty() ? study.output / "report.html" : command.out;
    check_output(output, {command.shared.study, ledger.path()});
    require_gnuplot();
    ProgressLine line(session, "drawing the report");
    write_file_atomically(output.out, study_page(study, results_of(study, ledger)));
    line.end();
    line.tell(fmt::format("wrote {}", output.out.string()));
    return good_result;
}

std::vector<std::size_t> subjects_of(const StudyResultCommand& command) {
    std::vector<std::size_t> subjects;
    for (const std::string_view word : split(command.subjects, ',')) {
        const auto count = parse_count(word);
        if (!count || *count < 2) {
            throw InputError({.where = fmt::format("--subjects {}", command.subjects),
                              .problem = fmt::format("\"{}\" is no number of subjects", word),
                              .why = "a group needs two at least",
                              .remedy = "give whole numbers, as in --subjects 10,20,50"});
        }
        subjects.push_back(*count);
    }
    return subjects;
}

int power_it(const StudyResultCommand& command, Session& session) {
    const Study study = study_of(command.shared);
    const PowerQuestion question{.quantity = command.quantity,
                                 .subjects = subjects_of(command),
                                 .power = command.power,
                                 .repeats = command.repeats};
    const Ledger ledger(ledger_of(command.shared, study), Ledger::Access::read);
    SharedOptions picture;
    picture.out = command.plot;
    check_picture(picture, "--plot", {command.shared.study, ledger.path()});
    ProgressLine line(session, "computing");
    const PowerAnswer answer = power_answer(study, answered(study, ledger.rows()), question);
    line.end();
    write_stdout(command.shared.format == "json" ? json_text(power_json(answer)) : power_text(answer));
    if (command.plot.empty()) return good_result;
    write_beside(session, command.plot, [&] {
        draw(power_figure({{.name = fmt::format("{} per subject", command.repeats), .design = answer.design}},
                          command.power, std::max<std::size_t>(3, std::ranges::max(question.subjects)),
                          {.name = command.quantity, .unit = unit_of(command.quantity)}),
             command.plot);
    });
    return good_result;
}

}  // namespace

void add_study_status_command(CLI::App& study, Session& session) {
    const auto status = std::make_shared<StudyResultCommand>();
    CLI::App* const status_app =
        add_study_subcommand(study, status->shared, "status", "count fitted, suspect, rejected, failed and pending");
    add_format_option(*status_app, status->shared.format, {"text", "json"});
    add_examples(*status_app, {"skinfit study status configs/study_example.json"},
                 "Exit code 0: every spectrum is fitted; 1: some are not; 2: bad input; 3: internal error.");
    status_app->callback([status, &session] { session.exit_code = status_it(*status, session); });
}

void add_study_export_command(CLI::App& study, Session& session) {
    const auto exported = std::make_shared<StudyResultCommand>();
    CLI::App* const export_app =
        add_study_subcommand(study, exported->shared, "export", "write the results as a table or as JSON");
    add_format_option(*export_app, exported->shared.format, {"csv", "json"});
    add_out_option(*export_app, exported->out);
    add_examples(*export_app, {"skinfit study export configs/study_example.json --out results.csv",
                               "skinfit study export configs/study_example.json --format json"});
    export_app->callback([exported, &session] { session.exit_code = export_it(*exported, session); });
}

void add_study_report_command(CLI::App& study, Session& session) {
    const auto report = std::make_shared<StudyResultCommand>();
    CLI::App* const report_app =
        add_study_subcommand(study, report->shared, "report", "write an HTML page with tables and plots");
    report_app
        ->add_option("--out", report->out, "write to this file instead of to report.html in the study's output folder")
        ->type_name("FILE");
    add_examples(*report_app, {"skinfit study report configs/study_example.json --out report.html"});
    report_app->callback([report, &session] { session.exit_code = report_it(*report, session); });
}

void add_study_power_command(CLI::App& study, Session& session) {
    const auto power = std::make_shared<StudyResultCommand>();
    CLI::App* const power_app =
        add_study_subcommand(study, power->shared, "power", "what difference between two groups such spectra can show");
    power_app
        ->add_option("--quantity", power->quantity,
                     "a parameter that the fits adjust, or an index such as erythema_index")
        ->type_name("NAME")
        ->required();
    power_app->add_option("--subjects", power->subjects, "numbers of subjects per group, 2 at least")
        ->type_name("N,N")
        ->capture_default_str();
    number(power_app->add_option("--power", power->power, "probability of finding the difference"), 0.06, 0.9999, "P")
        ->capture_default_str();
    whole_number(power_app->add_option("--repeats", power->repeats, "measurements of each subject, averaged"), 1, 1000)
        ->capture_default_str();
    power_app->add_option("--plot", power->plot, "draw the detectable differences into this file, .svg, .png or .pdf")
        ->type_name("FILE");
    add_format_option(*power_app, power->shared.format, {"text", "json"});
    add_examples(*power_app, {"skinfit study power configs/study_example.json --quantity melanosome_fraction "
                              "--subjects 10,20,50 --plot power.svg"});
    power_app->callback([power, &session] { session.exit_code = power_it(*power, session); });
}

}  // namespace skinfit
