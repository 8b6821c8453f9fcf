#include <fcntl.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <memory>
#include <new>
#include <optional>

#include "app/command_line_error.hpp"
#include "app/large_stack.hpp"
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

/// What a solver has to say is in its result; its log is no message to a user.
void silence_libraries() {
    FLAGS_minloglevel = google::GLOG_FATAL;
}

int run(int argc, char** argv, Interrupt& interrupt) {
    refuse_empty_arguments(argc, argv);
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
    return std::max<int>(session.exit_code, session.lacks_a_file ? result_with_warning : good_result);
}

/// The same, with what is wrong said.
int run_to_its_end(int argc, char** argv, Interrupt& interrupt) {
    try {
        return run(argc, argv, interrupt);
    } catch (const InputError& error) {
        say_trouble("error", error.what());
        return bad_input;
    } catch (const std::bad_alloc&) {
        say_trouble("error",
                    "memory: there is not enough (what was asked for needs more than is left); ask for fewer rays, "
                    "wavelengths, bins or spectra, run fewer threads (--threads), or free memory");
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
    skinfit::silence_libraries();
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
