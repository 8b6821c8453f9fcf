#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "core/file.hpp"
#include "fit/description.hpp"

namespace skinfit {

void add_describe_command(CLI::App& app, Session& session) {
    CLI::App* const describe =
        app.add_subcommand("describe", "say what a parameter, a setting or a word of the outputs stands for");
    const auto names = std::make_shared<std::vector<std::string>>();
    describe->add_option("NAME", *names, "names; without one: all parameters and settings");
    add_examples(*describe, {"skinfit describe", "skinfit describe bilirubin_g_per_l engine runs_p_value"});
    describe->callback([names, &session] {
        std::string text = names->empty() ? descriptions() : "";
        for (const std::string& name : *names) text += description(name);
        write_stdout(text);
        session.exit_code = trustworthy_result;
    });
}

}  // namespace skinfit
