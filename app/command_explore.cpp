#include <fmt/format.h>
#include <signal.h>

#include <thread>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "core/input_error.hpp"
#include "explore/page.hpp"
#include "explore/server.hpp"
#include "fit/inspection.hpp"
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

int run(const ExploreCommand& command, Session& session) {
    require_page();
    (void)session.stop_on_interrupt("");
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "reading");
    Api api(
        cache_from(command.shared, line),
        command.file.empty() ? std::nullopt : std::optional(read_spectra(command.file, {.window = usual_window()})));
    Server server(api, command.port);
    line.end();
    write_stdout(server.url() + "\n");
    line.tell("open this address in a browser of this machine; Ctrl-C ends the program");
    std::jthread serving([&server] { server.run(); });
    session.interrupt.wait();
    server.stop();
    return good_result;
}

}  // namespace

void add_explore_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<ExploreCommand>();
    CLI::App* const explore =
        app.add_subcommand("explore", "play with the skin model in a browser: sliders, measured spectra, fits");
    explore->add_option("FILE", command->file, "spectra to begin with, in any form that skinfit reads");
    whole_number(explore->add_option("--port", command->port, "of 127.0.0.1; 0: a free one"), 0, 65535)
        ->capture_default_str();
    add_threads_option(*explore, command->shared.threads);
    add_no_cache_option(*explore, command->shared.no_cache);
    add_examples(
        *explore, {"skinfit explore", "skinfit explore measurements/data/ncsu_113.csv --port 8080"},
        "Prints the address of the page, which holds a secret: whoever has it on this machine can use the server.\n"
        "Exit code 0: ended by Ctrl-C; 2: bad input; 3: internal error.");
    explore->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
