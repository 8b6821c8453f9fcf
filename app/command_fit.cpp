#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"
#include "fit/file_settings.hpp"
#include "fit/fit.hpp"
#include "fit/inspection.hpp"
#include "fit/report.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {
namespace {

struct FitCommand {
    SharedOptions shared;
    std::string file;
    std::string column;
    std::string reader;
    std::string unit;
    std::vector<std::string> free;
    std::vector<std::string> fix;
    bool cross_check = false;
    bool strict = false;
    std::string solver;
    std::string uncertainty;
    std::filesystem::path samples;
};

Configuration fit_configuration(const FitCommand& command, const Configuration& defaults) {
    Configuration configuration = configuration_from(command.shared, defaults);
    if (!command.solver.empty()) {
        configuration = configured_by_word(configuration, "solver", command.solver, "--solver");
    }
    if (!command.uncertainty.empty()) {
        configuration = configured_by_word(configuration, "uncertainty", command.uncertainty, "--uncertainty");
    }
    if (!command.column.empty()) configuration.column = command.column;
    if (!command.unit.empty()) configuration = configured_by_word(configuration, "unit", command.unit, "--unit");
    return with_free_and_fixed(configuration, command.free, command.fix);
}

void check_samples(const FitCommand& command, const Configuration& configuration) {
    if (command.samples.empty()) return;
    if (configuration.uncertainty != UncertaintyMethod::posterior) {
        throw InputError({.where = "--samples",
                          .problem = "there are none",
                          .why = "only a posterior is sampled",
                          .remedy = "add --uncertainty posterior"});
    }
    SharedOptions samples = command.shared;
    samples.out = command.samples;
    check_output(samples, {command.file, command.shared.out});
}

int run(const FitCommand& command) {
    const Configuration stated = fit_configuration(command, default_configuration());
    check_output(command.shared, {command.file});
    const Spectrum spectrum = read_spectrum(command.file, {.column = stated.column, .unit = stated.unit},
                                            command.reader.empty() ? std::nullopt : std::optional(command.reader));
    // What the file states holds where the configuration does not state it.
    const Configuration configuration =
        fit_configuration(command, with_file_settings(default_configuration(), spectrum));
    check_samples(command, configuration);
    const std::vector<Finding> findings = findings_before_fit(configuration, spectrum);
    if (command.strict) refuse_warnings(findings, spectrum.source);
    const auto limit = thread_limit(command.shared);
    const FitResult result =
        fit_spectrum(configuration, spectrum,
                     {.cross_check = command.cross_check, .cache = cache_from(command.shared), .findings = findings});
    if (!command.samples.empty()) {
        write_file_atomically(command.samples, samples_csv(*result.posterior, result.free));
    }
    write_output(command.shared,
                 command.shared.format == "json" ? json_text(json_report(result)) : text_report(result));
    return result.verdict == Verdict::trustworthy ? trustworthy_result : result_with_warning;
}

}  // namespace

void add_fit_command(CLI::App& app, int& exit_code) {
    const auto command = std::make_shared<FitCommand>();
    CLI::App* const fit = app.add_subcommand("fit", "explain a measured spectrum by skin biology");
    fit->add_option("FILE", command->file, "spectrum: text of columns or rows, JCAMP-DX, CGATS (.ti3) or JSON")
        ->required();
    fit->add_option("--column", command->column, "of a file with several spectra: its name, or its number from 1")
        ->type_name("NAME");
    add_reader_option(*fit, command->reader);
    fit->add_option("--unit", command->unit, "of the values: fraction or percent; found by a rule otherwise");
    fit->add_option("--free", command->free, "adjust these parameters too; `skinfit config show` lists their names")
        ->type_name("NAME,NAME")
        ->expected(1)
        ->take_all();
    fit->add_option("--fix", command->fix, "hold these parameters")->type_name("NAME,NAME")->expected(1)->take_all();
    fit->add_option("--uncertainty", command->uncertainty,
                    "what intervals come from: covariance, profile (right at bounds) or posterior");
    fit->add_option("--samples", command->samples, "write the draws of the posterior there, as CSV")->type_name("FILE");
    fit->add_option("--solver", command->solver,
                    "ceres (exact derivatives), slsqp (the same), bobyqa, sbplx (none), crs2 (global)");
    fit->add_flag("--strict", command->strict, "refuse a spectrum with warnings; `skinfit inspect` shows them");
    fit->add_flag("--cross-check", command->cross_check, "fit by the other solvers too and compare");
    add_shared_options(*fit, command->shared, {"text", "json"});
    fit->footer("Exit code 0: trustworthy; 1: a result with a warning; 2: bad input; 3: internal error.");
    fit->callback([command, &exit_code] { exit_code = run(*command); });
}

}  // namespace skinfit
