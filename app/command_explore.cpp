#include <fmt/format.h>
#include <signal.h>

#include <thread>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "core/input_error.hpp"
#include "explore/page.hpp"
#include "explore/server.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {
namespace {

struct ExploreCommand {
    std::filesystem::path file;
    SharedOptions shared;
    int port = 0;
};

void require_page() {
    if (!page_files().empty()) return;
    throw InputError({.where = "explore",
                      .problem = "this program has no page",
                      .why = "it was built with -DSKINFIT_WEB=OFF",
                      .remedy = "install nodejs and npm and build with -DSKINFIT_WEB=ON"});
}

/// Ctrl-C and the like, kept from every thread that starts afterwards so that one of them can wait for it.
sigset_t blocked_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    return signals;
}

int run(const ExploreCommand& command) {
    require_page();
    const sigset_t signals = blocked_signals();
    const auto limit = thread_limit(command.shared);
    Api api(cache_from(command.shared),
            command.file.empty() ? std::nullopt : std::optional(read_spectra(command.file)));
    Server server(api, command.port);
    write_stdout(server.url() + "\n");
    fmt::print(stderr, "open this address in a browser of this machine; Ctrl-C ends the program\n");
    std::jthread serving([&server] { server.run(); });
    int signal = 0;
    sigwait(&signals, &signal);
    server.stop();
    return trustworthy_result;
}

}  // namespace

void add_explore_command(CLI::App& app, int& exit_code) {
    const auto command = std::make_shared<ExploreCommand>();
    CLI::App* const explore =
        app.add_subcommand("explore", "play with the skin model in a browser: sliders, measured spectra, fits");
    explore->add_option("FILE", command->file, "spectra to begin with, in any form that skinfit reads");
    explore->add_option("--port", command->port, "of 127.0.0.1; 0: a free one")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    explore->add_option("--threads", command->shared.threads, "at most so many")->check(CLI::Range(1, 1024));
    explore->add_flag("--no-cache", command->shared.no_cache, "do not keep or use recorded walks");
    explore->footer(
        "Prints the address of the page, which holds a secret: whoever has it on this machine can use the server.\n"
        "Exit code 0: ended by Ctrl-C; 2: bad input; 3: internal error.");
    explore->callback([command, &exit_code] { exit_code = run(*command); });
}

}  // namespace skinfit
