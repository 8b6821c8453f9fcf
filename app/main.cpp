#include <fmt/format.h>

#include <exception>

#include "app/command_line_error.hpp"
#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"

namespace {

/// An empty argument is most often a variable of a script that was never set; none has a meaning here.
void refuse_empty_arguments(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        if (*argv[i] != '\0') continue;
        throw skinfit::InputError({.where = "command line",
                                   .problem = fmt::format("argument {} is empty", i),
                                   .why = "no file and no value has an empty name",
                                   .remedy = "give it, or leave its option out"});
    }
}

int run(int argc, char** argv) {
    refuse_empty_arguments(argc, argv);
    int exit_code = skinfit::trustworthy_result;
    CLI::App app("skinfit estimates skin biology from measured light. Research software, not a medical device.",
                 "skinfit");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string(skinfit::version));
    skinfit::add_fit_command(app, exit_code, skinfit::shell_words({argv, argv + argc}));
    skinfit::add_inspect_command(app, exit_code);
    skinfit::add_simulate_command(app, exit_code);
    skinfit::add_sensitivity_command(app, exit_code);
    skinfit::add_design_command(app, exit_code);
    skinfit::add_explore_command(app, exit_code);
    skinfit::add_gonio_command(app, exit_code);
    skinfit::add_validate_command(app, exit_code);
    skinfit::add_study_command(app, exit_code);
    skinfit::add_bench_command(app, exit_code);
    skinfit::add_convert_command(app, exit_code);
    skinfit::add_config_command(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        app.exit(help);
        skinfit::write_stdout("");  // flushes, and complains where that fails
    } catch (const CLI::ParseError& error) {
        throw skinfit::InputError(skinfit::command_line_complaint(app, error));
    }
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const skinfit::InputError& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return skinfit::bad_input;
    } catch (const std::exception& error) {
        fmt::print(stderr, "internal error: {}; please report it with the command that led to it\n", error.what());
        return skinfit::internal_error;
    }
}
