#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <memory>

#include "app/command_line_error.hpp"
#include "app/commands.hpp"
#include "app/large_stack.hpp"
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

int run(int argc, char** argv, Interrupt& interrupt) {
    refuse_empty_arguments(argc, argv);
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
    return std::max<int>(session.exit_code, session.lacks_a_file ? result_with_warning : trustworthy_result);
}

/// The same, with what is wrong said.
int run_to_its_end(int argc, char** argv, Interrupt& interrupt) {
    try {
        return run(argc, argv, interrupt);
    } catch (const InputError& error) {
        say_trouble("error", error.what());
        return bad_input;
    } catch (const std::exception& error) {
        say_trouble("internal error",
                    fmt::format("{}; please report it with the command that led to it", error.what()));
        return internal_error;
    }
}

}  // namespace
}  // namespace skinfit

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of the shell (ulimit -f) is an error of writing it
    skinfit::open_standard_streams();
    int exit_code = skinfit::internal_error;
    try {
        skinfit::Interrupt interrupt;  // its signals are kept from all threads that start later
        skinfit::on_a_large_stack([&] { exit_code = skinfit::run_to_its_end(argc, argv, interrupt); });
    } catch (const std::exception& error) {
        skinfit::say_trouble(
            "error", fmt::format("no thread can be started ({}); allow more memory or processes (ulimit -v, ulimit -u)",
                                 error.what()));
        return skinfit::bad_input;
    }
    return exit_code;
}
