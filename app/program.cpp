#include "app/program.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/shared_options.hpp"
#include "core/version.hpp"

namespace skinfit {
namespace {

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
    add_help_command(app, session);
    add_completion_command(app, session);
    add_manual_command(app, session);
    add_quiet(app, session);
    add_footers(app);
}

}  // namespace

std::unique_ptr<CLI::App> make_program(Session& session) {
    auto app = std::make_unique<CLI::App>(
        "skinfit estimates skin biology from measured light. Research software, not a medical device.", "skinfit");
    app->require_subcommand(1);
    app->set_help_flag("-h,--help", "say what there is, and end");
    app->set_version_flag("--version", std::string(version), "say which version this is, and end");
    app->formatter(std::make_shared<HelpForm>());
    app->footer(
        "`skinfit COMMAND --help` explains a command. To begin: skinfit fit measurements/data/ncsu_113.csv\n\n"
        "Exit code 0: done, a fit is consistent; 1: done, but a fit is suspect or failed, a study is not whole, a "
        "validation has not passed, or a file that was asked for could not be made; 2: bad input; 3: internal error; "
        "130: ended by Ctrl-C.");
    add_commands(*app, session);
    return app;
}

}  // namespace skinfit
