#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "app/study_options.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
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

int status_it(const StudyResultCommand& command) {
    const Study study = read_study(command.shared.study);
    const StudyCounts counts = counts_of(Ledger(ledger_of(command.shared, study), Ledger::Access::read));
    write_stdout(command.shared.format == "json" ? json_text(status_json(counts)) : status_text(counts));
    return exit_code_of(counts);
}

int export_it(const StudyResultCommand& command) {
    const Study study = read_study(command.shared.study);
    SharedOptions output;
    output.out = command.out;
    std::vector<std::filesystem::path> inputs = {command.shared.study, ledger_of(command.shared, study)};
    for (const StudyFile& file : study.files) inputs.push_back(file.path);
    check_output(output, inputs);
    const Ledger ledger(ledger_of(command.shared, study), Ledger::Access::read);
    const std::vector<AnsweredRow> rows = answered(study, ledger.rows());
    write_output(output, command.shared.format == "json" ? json_text(results_json(study, ledger, rows))
                                                         : study_csv(study, rows));
    return trustworthy_result;
}

int report_it(const StudyResultCommand& command) {
    const Study study = read_study(command.shared.study);
    const Ledger ledger(ledger_of(command.shared, study), Ledger::Access::read);
    SharedOptions output;
    output.out = command.out.empty() ? study.output / "report.html" : command.out;
    check_output(output, {command.shared.study, ledger.path()});
    write_output(output, study_page(study, results_of(study, ledger)));
    fmt::print(stderr, "wrote {}\n", output.out.string());
    return trustworthy_result;
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

int power_it(const StudyResultCommand& command) {
    const Study study = read_study(command.shared.study);
    const PowerQuestion question{.quantity = command.quantity,
                                 .subjects = subjects_of(command),
                                 .power = command.power,
                                 .repeats = command.repeats};
    const Ledger ledger(ledger_of(command.shared, study), Ledger::Access::read);
    const PowerAnswer answer = power_answer(study, answered(study, ledger.rows()), question);
    if (!command.plot.empty()) {
        draw(power_figure({{.name = fmt::format("{} per subject", command.repeats), .design = answer.design}},
                          command.power, std::max<std::size_t>(3, std::ranges::max(question.subjects)),
                          {.name = command.quantity, .unit = unit_of(command.quantity)}),
             command.plot);
    }
    write_stdout(command.shared.format == "json" ? json_text(power_json(answer)) : power_text(answer));
    return trustworthy_result;
}

}  // namespace

void add_study_status_command(CLI::App& study, int& exit_code) {
    const auto status = std::make_shared<StudyResultCommand>();
    CLI::App* const status_app =
        add_study_subcommand(study, status->shared, "status", "count fitted, suspect, rejected, failed and pending");
    add_study_formats(*status_app, status->shared, {"text", "json"});
    status_app->callback([status, &exit_code] { exit_code = status_it(*status); });
}

void add_study_export_command(CLI::App& study, int& exit_code) {
    const auto exported = std::make_shared<StudyResultCommand>();
    CLI::App* const export_app =
        add_study_subcommand(study, exported->shared, "export", "write the results as a table or as JSON");
    add_study_formats(*export_app, exported->shared, {"csv", "json"});
    export_app->add_option("--out", exported->out, "write there instead of to the terminal")->type_name("FILE");
    export_app->callback([exported, &exit_code] { exit_code = export_it(*exported); });
}

void add_study_report_command(CLI::App& study, int& exit_code) {
    const auto report = std::make_shared<StudyResultCommand>();
    CLI::App* const report_app =
        add_study_subcommand(study, report->shared, "report", "write a page with tables and plots");
    report_app->add_option("--out", report->out, "write there instead of to report.html in the output folder")
        ->type_name("FILE");
    report_app->callback([report, &exit_code] { exit_code = report_it(*report); });
}

void add_study_power_command(CLI::App& study, int& exit_code) {
    const auto power = std::make_shared<StudyResultCommand>();
    CLI::App* const power_app =
        add_study_subcommand(study, power->shared, "power", "what difference between two groups such spectra can show");
    power_app->add_option("--quantity", power->quantity, "a parameter that the fits adjust, or an index")->required();
    power_app->add_option("--subjects", power->subjects, "numbers of subjects per group")
        ->type_name("N,N")
        ->capture_default_str();
    power_app->add_option("--power", power->power, "probability of finding the difference")
        ->check(CLI::Range(0.06, 0.9999))
        ->capture_default_str();
    power_app->add_option("--repeats", power->repeats, "measurements of each subject, averaged")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    power_app->add_option("--plot", power->plot, "draw detectable differences there, .svg, .png or .pdf")
        ->type_name("FILE");
    add_study_formats(*power_app, power->shared, {"text", "json"});
    power_app->callback([power, &exit_code] { exit_code = power_it(*power); });
}

}  // namespace skinfit
