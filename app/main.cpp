#include <fcntl.h>
#include <fmt/format.h>

#include <exception>
#include <memory>
#include <new>

#include "app/command_line_error.hpp"
#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/shared_options.hpp"
#include "app/terminal.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"

namespace skinfit {
namespace {

/// An empty argument is most often a variable of a script that was never set; none has a meaning here.
void refuse_empty_arguments(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        if (*argv[i] != '\0') continue;
        throw InputError({.where = "command line",
                          .problem = fmt::format("argument {} is empty", i),
                          .why = "no file and no value has an empty name",
                          .remedy = "give it, or leave its option out"});
    }
}

/// Gives every command that can be run the option --quiet.
void add_quiet(CLI::App& app, Session& session) {
    const std::vector<CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
    for (CLI::App* command : commands) add_quiet(*command, session);
    if (!commands.empty() || app.get_option_no_throw("--quiet") != nullptr) return;
    add_quiet_option(app, session);
}

/// Ends the help of every command that has subcommands.
void add_footers(CLI::App& app) {
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (command->get_subcommands([](const CLI::App*) { return true; }).empty()) continue;
        command->footer(
            fmt::format("`skinfit {} COMMAND --help` explains a command and its exit codes.", command->get_name()));
    }
}

void add_commands(CLI::App& app, Session& session) {
    add_fit_command(app, session);
    add_inspect_command(app, session);
    add_simulate_command(app, session);
    add_sensitivity_command(app, session);
    add_design_command(app, session);
    add_explore_command(app, session);
    add_gonio_command(app, session);
    add_validate_command(app, session);
    add_study_command(app, session);
    add_bench_command(app, session);
    add_convert_command(app, session);
    add_describe_command(app, session);
    add_config_command(app, session);
    add_completion_command(app, session);
    add_manual_command(app, session);
    add_quiet(app, session);
    add_footers(app);
}

/// Opens what the caller has closed of standard input, output and error, so that no file takes their place.
void open_standard_streams() {
    for (int descriptor = 0; descriptor <= 2; ++descriptor) {
        if (::fcntl(descriptor, F_GETFD) >= 0) continue;
        (void)::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY);  // using it fails, as if it were closed
    }
}

int run(int argc, char** argv) {
    open_standard_streams();
    refuse_empty_arguments(argc, argv);
    Interrupt interrupt;
    Session session{.command_line = shell_words({argv, argv + argc}), .interrupt = interrupt};
    CLI::App app("skinfit estimates skin biology from measured light. Research software, not a medical device.",
                 "skinfit");
    app.require_subcommand(1);
    app.set_help_flag("-h,--help", "say what there is, and end");
    app.set_version_flag("--version", std::string(version), "say which version this is, and end");
    app.formatter(std::make_shared<HelpForm>());
    app.footer(
        "`skinfit COMMAND --help` explains a command. To begin: skinfit fit measurements/data/ncsu_113.csv\n\n"
        "Exit code 0: done, a fit is trustworthy; 1: done, but a fit is suspect or failed, a study is not whole, or a "
        "validation has not passed; 2: bad input; 3: internal error; 130: ended by Ctrl-C.");
    add_commands(app, session);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        app.exit(help);
        write_stdout("");  // flushes, and complains where that fails
    } catch (const CLI::ParseError& error) {
        throw InputError(command_line_complaint(app, error));
    }
    return session.exit_code;
}

}  // namespace
}  // namespace skinfit

int main(int argc, char** argv) {
    try {
        return skinfit::run(argc, argv);
    } catch (const skinfit::InputError& error) {
        skinfit::say_trouble("error", error.what());
        return skinfit::bad_input;
    } catch (const std::bad_alloc&) {
        skinfit::say_trouble("error",
                             "memory: there is not enough (what was asked for needs more than is left); ask for fewer "
                             "rays, wavelengths, bins or spectra, run fewer threads (--threads), or free memory");
        return skinfit::bad_input;
    } catch (const std::exception& error) {
        skinfit::say_trouble("internal error",
                             fmt::format("{}; please report it with the command that led to it", error.what()));
        return skinfit::internal_error;
    }
}
