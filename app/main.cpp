#include <fmt/format.h>

#include <exception>

#include "app/commands.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"

namespace {

/// The first line of what CLI11 says, which may have several.
std::string first_line(std::string text) {
    return text.substr(0, text.find('\n'));
}

int run(int argc, char** argv) {
    int exit_code = skinfit::trustworthy_result;
    CLI::App app("skinfit estimates skin biology from measured light. Research software, not a medical device.",
                 "skinfit");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string(skinfit::version));
    skinfit::add_fit_command(app, exit_code);
    skinfit::add_simulate_command(app, exit_code);
    skinfit::add_gonio_command(app, exit_code);
    skinfit::add_config_command(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "error: command line: {} (it is not understood); see `skinfit --help`\n",
                   first_line(error.what()));
        return skinfit::bad_input;
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
