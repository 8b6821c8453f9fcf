#include <fmt/format.h>

#include <algorithm>

#include "app/commands.hpp"
#include "app/measured_file.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/region_options.hpp"
#include "app/shared_options.hpp"
#include "app/terminal.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "fit/gnuplot.hpp"
#include "fit/inspection.hpp"
#include "fit/report.hpp"
#include "measurements/text_reader.hpp"
#include "report/fit_picture.hpp"
#include "report/fit_report.hpp"

namespace skinfit {
namespace {

struct FitCommand {
    SharedOptions shared;
    std::vector<std::string> files;
    std::vector<std::string> columns;
    std::string reader;
    RegionOptions region;
    std::string unit;
    std::vector<std::string> free;
    std::vector<std::string> fix;
    std::vector<std::string> own;
    bool cross_check = false;
    bool strict = false;
    std::string solver;
    std::string uncertainty;
    std::filesystem::path samples;
    std::filesystem::path report;
    std::filesystem::path plot;
};

Configuration fit_configuration(const FitCommand& command) {
    Configuration configuration = configuration_from(command.shared);
    if (!command.solver.empty()) {
        configuration = configured_by_word(configuration, "solver", command.solver, "--solver");
    }
    if (!command.uncertainty.empty()) {
        configuration = configured_by_word(configuration, "uncertainty", command.uncertainty, "--uncertainty");
    }
    if (command.columns.size() == 1) configuration.column = command.columns.front();
    if (!command.unit.empty()) configuration = configured_by_word(configuration, "unit", command.unit, "--unit");
    configuration = with_free_and_fixed(configuration, command.free, command.fix);
    for (const std::string& names : command.own) configuration = with_own(configuration, names, "--own");
    return configuration;
}

std::vector<std::filesystem::path> inputs(const FitCommand& command) {
    std::vector<std::filesystem::path> all;
    for (const std::string& file : command.files) {
        for (const std::filesystem::path& path : files_read(file, command.region)) all.push_back(path);
    }
    return all;
}

/// One per file and column: columns belong to the one file, or to the files in their order, or the one to all files.
std::vector<Spectrum> read_all(const FitCommand& command, const Configuration& stated, MeasuredFiles& measured) {
    const std::size_t files = command.files.size();
    const std::size_t columns = command.columns.size();
    if (files > 1 && columns > 1 && files != columns) {
        throw InputError({.where = "--column",
                          .problem = fmt::format("{} columns for {} files", columns, files),
                          .why = "which column belongs to which file is not clear",
                          .remedy = "give one for each file, or one for all"});
    }
    if (std::ranges::count_if(command.files, is_standard_input) > 1) {
        throw InputError({.where = "FILE",
                          .problem = "standard input twice",
                          .why = "it can be read once",
                          .remedy = "give - once, and name the columns of several spectra by --column"});
    }
    std::vector<Spectrum> spectra;
    for (std::size_t k = 0; k < std::max(files, columns); ++k) {
        const std::string& file = command.files[files == 1 ? 0 : k];
        ReadOptions options{.column = stated.column,
                            .unit = stated.unit,
                            .region = region_from(command.region),
                            .window = window_of(stated)};
        if (columns > 1) options.column = command.columns[k];
        spectra.push_back(measured.spectrum(file, options));
    }
    return spectra;
}

/// Refuses what cannot be written, or would replace one of these files, before the work rather than after it.
void check_outputs(const FitCommand& command, const std::vector<std::filesystem::path>& read) {
    if (!command.plot.empty()) (void)gnuplot_terminal(command.plot, {.width = 1, .height = 1});  // the suffix
    const std::vector<std::pair<std::string, std::filesystem::path>> outputs = {{"--out", command.shared.out},
                                                                                {"--report", command.report},
                                                                                {"--plot", command.plot},
                                                                                {"--samples", command.samples}};
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto& [option, path] = outputs[i];
        SharedOptions one = command.shared;
        one.out = path;
        check_output(one, read, option);
        for (std::size_t k = 0; k < i; ++k) refuse_same_output(outputs[k], outputs[i]);
    }
}

void check_samples(const FitCommand& command, const Configuration& configuration) {
    if (command.samples.empty() || configuration.uncertainty == UncertaintyMethod::posterior) return;
    throw InputError({.where = "--samples",
                      .problem = "there are no draws to write",
                      .why = "only --uncertainty posterior draws any",
                      .remedy = "add --uncertainty posterior"});
}

/// The result, with a bar while it is looked for; none where Ctrl-C ends the search.
std::optional<FitResult> fitted(const FitCommand& command, const FitInput& input, const std::vector<Finding>& findings,
                                Session& session) {
    ProgressLine line(session, "fitting");
    const FitWatch watch{.stop = session.stop_on_interrupt(""),
                         .progress =
                             [&line](const FitProgress& now) {
                                 line.show({.what = std::string(now.stage), .done = now.done, .total = now.total});
                             },
                         .keeps_partial_result = true};
    try {
        return fit_spectra(input, {.cross_check = command.cross_check,
                                   .cache = cache_from(command.shared, line),
                                   .findings = findings,
                                   .watch = watch});
    } catch (const Cancelled&) {
        line.end();
        line.tell("interrupted; there is no result yet, and nothing was written");
        return std::nullopt;
    }
}

void write_files(const FitCommand& command, const FitResult& result, const Session& session) {
    if (!command.samples.empty() && !result.posterior && !session.quiet) {
        say_line(fmt::format("{}: not written; the posterior was not finished", command.samples.string()));
    }
    if (!command.samples.empty() && result.posterior) {
        std::vector<std::string> names;
        for (const FittedParameter& free : result.free) names.push_back(free.name);
        write_file_atomically(command.samples, samples_csv(*result.posterior, names));
    }
    if (!command.plot.empty()) write_file_atomically(command.plot, fit_picture(result.spectra, command.plot));
    if (!command.report.empty()) {
        write_file_atomically(command.report, html_report(result, {.command_line = session.command_line}));
    }
}

int run(const FitCommand& command, Session& session) {
    const Configuration configuration = fit_configuration(command);
    check_outputs(command, inputs(command));
    check_samples(command, configuration);
    MeasuredFiles measured(command.reader, session.quiet);
    const FitInput input = fit_input(configuration, read_all(command, configuration, measured));
    check_outputs(command, measured.files_of_cubes());
    const std::vector<Finding> findings = findings_before_fit(input);
    if (command.strict) refuse_warnings(findings, input.parts.front().spectrum.source);
    const auto limit = thread_limit(command.shared);
    const std::optional<FitResult> result = fitted(command, input, findings, session);
    if (!result) return session.interrupt.exit_code();
    write_files(command, *result, session);
    write_output(command.shared,
                 command.shared.format == "json" ? json_text(json_report(*result)) : text_report(*result));
    if (session.interrupt.signal()) return session.interrupt.exit_code();
    return result->verdict == Verdict::trustworthy ? trustworthy_result : result_with_warning;
}

}  // namespace

void add_fit_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<FitCommand>();
    CLI::App* const fit = app.add_subcommand("fit", "explain a measured spectrum by skin biology");
    fit->add_option("FILE", command->files,
                    "spectrum: text of columns or rows, JCAMP-DX, CGATS (.ti3), JSON or ENVI; - is standard input; "
                    "several are explained together")
        ->required();
    fit->add_option("--column", command->columns,
                    "of a file with several spectra, which has no default: the name of one, or its number from 1; "
                    "given again, one for each file, or several of one file")
        ->type_name("NAME")
        ->expected(1)
        ->take_all();
    add_reader_option(*fit, command->reader);
    add_region_options(*fit, command->region);
    fit->add_option("--unit", command->unit, "of the values; found by a rule otherwise")
        ->type_name(choices(unit_names));
    add_names_option(
        *fit, "--free", command->free,
        "adjust these parameters too, beside those that are free; `skinfit config show` lists all, and which are");
    add_names_option(*fit, "--fix", command->fix, "hold these parameters at their configured value");
    add_names_option(*fit, "--own", command->own,
                     "adjust these parameters, with a value of its own in each of several spectra");
    fit->add_option("--uncertainty", command->uncertainty,
                    "what intervals come from: covariance (quick), profile (right at bounds) or posterior (draws of "
                    "all parameters)" +
                        unless_configured("uncertainty"))
        ->type_name(choices(uncertainty_names));
    fit->add_option("--samples", command->samples,
                    "write the draws of the posterior to this file, as CSV; needs --uncertainty posterior")
        ->type_name("FILE");
    fit->add_option("--report", command->report, "write the whole result to this file, as one self-contained HTML page")
        ->type_name("FILE");
    fit->add_option("--plot", command->plot,
                    "draw measured and modelled spectrum and their difference into this file, .svg, .png or .pdf")
        ->type_name("FILE");
    fit->add_option(
           "--solver", command->solver,
           "what looks for the best values, not how the model is computed (--set engine=...): ceres and slsqp by exact "
           "derivatives, bobyqa and sbplx without, crs2 by searching everywhere" +
               unless_configured("solver"))
        ->type_name(choices(solver_names));
    fit->add_flag("--strict", command->strict, "refuse a spectrum with warnings; `skinfit inspect` shows them");
    fit->add_flag("--cross-check", command->cross_check, "fit by each of the other solvers too, and compare");
    add_shared_options(*fit, command->shared, {"text", "json"});
    add_examples(
        *fit,
        {"skinfit fit measurements/data/ncsu_113.csv",
         "skinfit fit measurements/data/ncsu_113.csv --set 'discrepancy={}' --report fit.html --plot fit.png",
         "skinfit fit measurements/data/ncsu_113.csv --free scale --fix bilirubin_g_per_l --format json --out fit.json",
         "skinfit fit measurements/data/ncsu_113.csv --set engine=emulator --uncertainty profile",
         "skinfit simulate --set melanosome_fraction=0.03 | skinfit fit - --column reflectance"},
        "Exit code 0: trustworthy; 1: suspect or failed, as the verdict says; 2: bad input; 3: internal error; 130: "
        "ended by Ctrl-C.");
    fit->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
