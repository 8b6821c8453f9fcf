#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "core/file.hpp"
#include "fit/description.hpp"

namespace skinfit {
namespace {

/// What the words mean as one label, else each by itself.
std::string descriptions_of(const std::vector<std::string>& words) {
    const std::string label = fmt::format("{}", fmt::join(words, " "));
    if (const std::optional<std::string> text = description_of(label)) return *text;
    std::string text;
    for (const std::string& word : words) text += description(word);
    return text;
}

}  // namespace

void add_describe_command(CLI::App& app, Session& session) {
    CLI::App* const describe =
        app.add_subcommand("describe", "say what a parameter, a setting or a word of the outputs stands for");
    const auto names = std::make_shared<std::vector<std::string>>();
    describe->add_option("NAME", *names, "names, or the words of one label; without any: all parameters and settings");
    add_examples(*describe, {"skinfit describe", "skinfit describe bilirubin_g_per_l engine slow_residuals_p_value",
                             "skinfit describe RESIDUALS IN RUNS", "skinfit describe melanin"});
    describe->callback([names, &session] {
        write_stdout(names->empty() ? descriptions() : descriptions_of(*names));
        session.exit_code = good_result;
    });
}

}  // namespace skinfit
