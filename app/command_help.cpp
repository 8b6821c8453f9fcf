#include "app/command_line_error.hpp"
#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace skinfit {
namespace {

/// The command that is called by `words`, as in {"study", "run"}; without any the program itself. Throws InputError.
const CLI::App& named_command(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    for (const std::string& word : words) {
        const auto found = command->get_subcommands([&](const CLI::App* each) { return each->get_name() == word; });
        if (found.empty()) throw InputError(unknown_word(*command, word));
        command = found.front();
    }
    return *command;
}

}  // namespace

void add_help_command(CLI::App& app, Session& session) {
    CLI::App* const help = app.add_subcommand("help", "say what there is, or explain a command");
    const auto words = std::make_shared<std::vector<std::string>>();
    help->add_option("COMMAND", *words, "the command, as in study run; without one: all commands");
    add_examples(*help, {"skinfit help", "skinfit help fit", "skinfit help study run"});
    help->callback([words, &app, &session] {
        write_stdout(help_of(named_command(app, *words)));
        session.exit_code = good_result;
    });
}

}  // namespace skinfit
