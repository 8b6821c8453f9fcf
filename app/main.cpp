#include <fcntl.h>
#include <fmt/format.h>

#include <exception>
#include <memory>
#include <optional>

#include "app/command_line_error.hpp"
#include "app/program.hpp"
#include "app/shared_options.hpp"
#include "app/terminal.hpp"
#include "core/input_error.hpp"

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
    const std::unique_ptr<CLI::App> app = make_program(session);
    try {
        app->parse(argc, argv);
    } catch (const CLI::Success& help) {
        app->exit(help);
        write_stdout("");  // flushes, and complains where that fails
    } catch (const CLI::ParseError& error) {
        const std::optional<std::string> help = help_of_unfinished(*app);
        if (!help) throw InputError(command_line_complaint(*app, error));
        write_stdout(*help);
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
    } catch (const std::exception& error) {
        skinfit::say_trouble("internal error",
                             fmt::format("{}; please report it with the command that led to it", error.what()));
        return skinfit::internal_error;
    }
}
