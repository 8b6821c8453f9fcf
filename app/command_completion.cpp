#include "app/command_tree.hpp"
#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/manual.hpp"
#include "app/option_limits.hpp"
#include "app/shared_options.hpp"
#include "fit/configuration_json.hpp"
#include "model/parameters.hpp"

namespace skinfit {
namespace {

CompletedNames completed_names() {
    CompletedNames names;
    for (const ParameterInfo& info : parameter_table()) names.parameters.emplace_back(info.name);
    names.settings = names.parameters;
    const Json settings = to_json(default_configuration());
    for (const auto& [key, value] : settings.items()) {
        if (key != "parameters") names.settings.push_back(key);
    }
    return names;
}

}  // namespace

void add_completion_command(CLI::App& app, Session& /*session*/) {
    CLI::App* const completion =
        app.add_subcommand("completion", "print a script that lets a shell complete commands, options and names");
    const auto shell = std::make_shared<std::string>();
    one_of(completion->add_option("SHELL", *shell, "bash, zsh or fish")->required(), {"bash", "zsh", "fish"});
    add_examples(*completion, {"skinfit completion bash > ~/.local/share/bash-completion/completions/skinfit",
                               "skinfit completion fish > ~/.config/fish/completions/skinfit.fish",
                               "skinfit completion zsh > _skinfit        # in a folder of $fpath"});
    completion->callback([shell, &app] {
        const CommandWords program = command_words(app);
        const CompletedNames names = completed_names();
        if (*shell == "bash") return write_stdout(bash_completion(program, names));
        write_stdout(*shell == "zsh" ? zsh_completion(program, names) : fish_completion(program, names));
    });
}

void add_manual_command(CLI::App& app, Session& /*session*/) {
    CLI::App* const manual = app.add_subcommand("manual", "print the manual page");
    add_examples(*manual, {"skinfit manual | man -l -"});
    manual->callback([&app] { write_stdout(manual_page(command_words(app))); });
}

}  // namespace skinfit
