#include "app/command_tree.hpp"

#include <algorithm>
#include <string_view>

#include "app/option_limits.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace {

/// "text" and "json" from the placeholder "text|json".
std::vector<std::string> choices_in(const std::string& type) {
    if (type.find('|') == std::string::npos) return {};
    std::vector<std::string> choices;
    for (const std::string_view word : split(type, '|')) choices.emplace_back(word);
    return choices;
}

std::string argument_of(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return "";
    return option.get_type_name();
}

OptionWords option_words(const CLI::Option& option) {
    const std::string limits = limits_of(option);
    OptionWords words{.names = {},
                      .argument = option.get_positional() ? option.get_name(true) : argument_of(option),
                      .choices = choices_in(option.get_type_name()),
                      .default_text = option.get_default_str(),
                      .meaning = option.get_description() + (limits.empty() ? "" : " (" + limits + ")"),
                      .required = option.get_required(),
                      .repeats = option.get_items_expected_max() > 1 ||
                                 option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll};
    for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
    return words;
}

CommandWords words_of(const CLI::App& app, const std::string& name) {
    CommandWords words{
        .name = name, .meaning = app.get_description(), .footer = app.get_footer(), .options = {}, .commands = {}};
    for (const CLI::Option* option : app.get_options()) {
        const bool is_shown = !option->get_group().empty();
        if (is_shown) words.options.push_back(option_words(*option));
    }
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        words.commands.push_back(
            words_of(*command, name.empty() ? command->get_name() : name + " " + command->get_name()));
    }
    return words;
}

}  // namespace

CommandWords command_words(const CLI::App& app) {
    return words_of(app, "");
}

std::vector<CommandWords> leaves(const CommandWords& command) {
    if (command.commands.empty()) return {command};
    std::vector<CommandWords> all;
    for (const CommandWords& each : command.commands) std::ranges::copy(leaves(each), std::back_inserter(all));
    return all;
}

}  // namespace skinfit
