#include <fmt/format.h>

#include <algorithm>

#include "app/commands.hpp"
#include "app/fit_inputs.hpp"
#include "app/measured_file.hpp"
#include "app/option_limits.hpp"
#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/region_options.hpp"
#include "app/separate_fits.hpp"
#include "app/shared_options.hpp"
#include "app/terminal.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "fit/gnuplot.hpp"
#include "fit/inspection.hpp"
#include "fit/preset.hpp"
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
    bool joint = false;
    bool cross_check = false;
    bool strict = false;
    std::string solver;
    std::string uncertainty;
    std::filesystem::path samples;
    std::filesystem::path report;
    std::filesystem::path plot;
};

Configuration fit_configuration(const FitCommand& command) {
    Configuration configuration = configuration_from(command.shared, measured_configuration());
    if (!command.solver.empty()) {
        configuration = configured_by_word(configuration, "solver", command.solver, "--solver");
    }
    if (!command.uncertainty.empty()) {
        configuration = configured_by_word(configuration, "uncertainty", command.uncertainty, "--uncertainty");
    }
    if (command.columns.size() == 1) configuration.column = command.columns.front();
    if (!command.unit.empty()) configuration = configured_by_word(configuration, "unit", command.unit, "--unit");
    return with_free_and_fixed(configuration, command.free, command.fix, command.own);
}

std::vector<std::filesystem::path> inputs(const FitCommand& command) {
    std::vector<std::filesystem::path> all;
    for (const std::string& file : command.files) {
        for (const std::filesystem::path& path : files_read(file, command.region)) all.push_back(path);
    }
    return all;
}

/// Refuses what cannot be written, or would replace one of these files, before the work rather than after it.
void check_outputs(const FitCommand& command, const std::vector<std::filesystem::path>& read) {
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

/// Refuses pictures that cannot be drawn.
void check_pictures(const FitCommand& command) {
    if (!command.plot.empty()) (void)gnuplot_terminal(command.plot, {.width = 1, .height = 1});  // the suffix
    if (!command.plot.empty() || !command.report.empty()) require_gnuplot();
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

/// What is written beside the result: draws first, then pages and pictures.
void write_files(const FitCommand& command, const FitResult& result, Session& session) {
    if (!command.samples.empty() && !result.posterior && !session.quiet) {
        say_line(fmt::format("{}: not written; the posterior was not finished", command.samples.string()));
    }
    if (!command.samples.empty() && result.posterior) {
        std::vector<std::string> names;
        for (const FittedParameter& free : result.free) names.push_back(free.name);
        write_beside(session, command.samples,
                     [&] { write_file_atomically(command.samples, samples_csv(*result.posterior, names)); });
    }
    if (!command.report.empty()) {
        write_beside(session, command.report, [&] {
            write_file_atomically(command.report, html_report(result, {.command_line = session.command_line}));
        });
    }
    if (!command.plot.empty()) {
        write_beside(session, command.plot,
                     [&] { write_file_atomically(command.plot, fit_picture(result.spectra, command.plot)); });
    }
}

/// All of them by one specimen.
int run_joint(const FitCommand& command, const Configuration& configuration, const std::vector<NamedSpectrum>& named,
              Session& session) {
    std::vector<Spectrum> spectra;
    for (const NamedSpectrum& each : named) {
        if (each.refusal) throw *each.refusal;
        spectra.push_back(*each.spectrum);
    }
    check_samples(command, configuration);
    const FitInput input = fit_input(configuration, spectra);
    const std::vector<Finding> findings = findings_before_fit(input);
    if (command.strict) refuse_warnings(findings, input.parts.front().spectrum.source);
    const auto limit = thread_limit(command.shared);
    const std::optional<FitResult> result = fitted(command, input, findings, session);
    if (!result) return session.interrupt.exit_code();
    write_result(command.shared,
                 command.shared.format == "json" ? json_text(json_report(*result)) : text_report(*result),
                 [&] { write_files(command, *result, session); });
    if (session.interrupt.signal()) return session.interrupt.exit_code();
    return result->verdict == Verdict::consistent ? good_result : result_with_warning;
}

/// What belongs to one fit has no place for several.
void refuse_files_of_one(const FitCommand& command) {
    const std::vector<std::pair<std::string, std::filesystem::path>> of_one = {
        {"--report", command.report}, {"--plot", command.plot}, {"--samples", command.samples}};
    for (const auto& [option, path] : of_one) {
        if (path.empty()) continue;
        throw InputError({.where = fmt::format("{} {}", option, path.string()),
                          .problem = "cannot hold several fits",
                          .why = "several spectra are each fitted by itself, and the file would show one of them",
                          .remedy = "fit one at a time, add --joint where all are of one specimen, or describe them "
                                    "as a study, whose report holds all (`skinfit help study`)"});
    }
}

/// The result of one of several, or why there is none; nothing where Ctrl-C ended it.
std::optional<SeparateFit> separate_fit(const FitCommand& command, const Configuration& configuration,
                                        const NamedSpectrum& named, Session& session) {
    SeparateFit fit{.file = named.name, .result = {}, .problem = {}};
    try {
        if (named.refusal) throw *named.refusal;
        const FitInput input = fit_input(configuration, {&*named.spectrum, 1});
        const std::vector<Finding> findings = findings_before_fit(input);
        if (command.strict) refuse_warnings(findings, named.spectrum->source);
        fit.result = fitted(command, input, findings, session);
        if (!fit.result) return std::nullopt;
    } catch (const InputError& error) {
        say_trouble("error", error.what());
        fit.problem = error.what();
    }
    return fit;
}

/// Each of them by itself: what one cannot do, the others do.
int run_apart(const FitCommand& command, const Configuration& configuration, const std::vector<NamedSpectrum>& named,
              Session& session) {
    refuse_files_of_one(command);
    const auto limit = thread_limit(command.shared);
    std::vector<SeparateFit> fits;
    for (const NamedSpectrum& each : named) {
        if (session.interrupt.signal()) break;
        std::optional<SeparateFit> fit = separate_fit(command, configuration, each, session);
        if (!fit) break;
        fits.push_back(std::move(*fit));
    }
    write_output(command.shared,
                 command.shared.format == "json" ? json_text(separate_fits_json(fits)) : separate_fits_text(fits));
    return session.interrupt.signal() ? session.interrupt.exit_code() : exit_code_of(fits);
}

int run(const FitCommand& command, Session& session) {
    const Configuration configuration = fit_configuration(command);
    check_pictures(command);
    check_outputs(command, inputs(command));
    MeasuredFiles measured(command.reader, session.quiet);
    const ReadOptions options{.column = configuration.column,
                              .unit = configuration.unit,
                              .region = region_from(command.region),
                              .window = window_of(configuration)};
    const std::vector<NamedSpectrum> named =
        read_spectra_named({.files = command.files, .columns = command.columns, .options = options}, measured);
    check_outputs(command, measured.files_of_cubes());
    const bool joint = named.size() == 1 || command.joint || !command.own.empty() || state_one_specimen(named);
    return joint ? run_joint(command, configuration, named, session)
                 : run_apart(command, configuration, named, session);
}

}  // namespace

void add_fit_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<FitCommand>();
    CLI::App* const fit = app.add_subcommand("fit", "explain a measured spectrum by skin biology");
    fit->add_option("FILE", command->files,
                    "spectrum: text of columns or rows, JCAMP-DX, CGATS (.ti3), JSON or ENVI; - is standard input; "
                    "several are each fitted by itself, but for spectra of one specimen: see --joint")
        ->required();
    repeated(fit->add_option("--column", command->columns,
                             "of a file with several spectra, which has no default: the name of one, or its number "
                             "from 1; given again, one for each file, or several of one file"))
        ->type_name("NAME");
    fit->add_flag(
        "--joint", command->joint,
        "explain all FILEs, or columns, by one specimen, as the reflectance and transmittance of one; so they "
        "are without it where all files state the same specimen, and with --own");
    add_reader_option(*fit, command->reader);
    add_region_options(*fit, command->region);
    fit->add_option("--unit", command->unit, "of the values; found by a rule otherwise")
        ->type_name(choices(unit_names));
    add_names_option(
        *fit, "--free", command->free,
        "adjust these parameters too, beside those that are free; `skinfit config show` lists all, and which are");
    add_names_option(*fit, "--fix", command->fix, "hold these parameters at their configured value");
    add_names_option(*fit, "--own", command->own,
                     "adjust these parameters, with a value of its own in each of several spectra of one specimen");
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
         "skinfit fit measurements/data/ncsu_*.csv --set engine=emulator",
         "skinfit simulate --set melanosome_fraction=0.03 | skinfit fit - --column reflectance"},
        "Exit code 0: consistent; 1: suspect or failed, as the verdict says; 2: bad input; 3: internal error; 130: "
        "ended by Ctrl-C. Of several fits the worst.");
    fit->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
