#include "app/command_line_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/nearest_names.hpp"
#include "fit/name_lists.hpp"
#include "fit/settings.hpp"

namespace skinfit {
namespace {

/// The command that was being read when `app` gave up.
const CLI::App& command_read(const CLI::App& app) {
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    return *command;
}

/// The words by which a command is called, as in "skinfit study run".
std::string called(const CLI::App& command) {
    if (command.get_parent() == nullptr) return command.get_name();
    return called(*command.get_parent()) + " " + command.get_name();
}

std::string see_help_of(const CLI::App& command) {
    return fmt::format("see `{} --help`", called(command));
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// What `name` probably means, as the beginning of a remedy; empty where nothing is near. `before` is what is to be
/// written before it.
std::string suggestion(std::string_view name, const std::vector<std::string>& names, const std::string& before = "") {
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::vector<std::string_view> meant = meant_names(name, known);
    return meant.empty() ? "" : fmt::format("did you mean {}? Else ", either(meant, before, before.empty() ? "" : "`"));
}

/// The same for an option; it may be a setting or a parameter, which --set changes where the command has it.
std::string option_suggestion(const CLI::App& command, const std::string& option) {
    if (const std::string slip = suggestion(option, option_names(command)); !slip.empty()) return slip;
    if (command.get_option_no_throw("--set") == nullptr) return "";
    std::vector<std::string_view> known = parameter_names();
    for (const Setting& setting : setting_table()) known.push_back(setting.name);
    const std::vector<std::string_view> meant = meant_names(spelt(option), known);
    return meant.empty() ? "" : fmt::format("did you mean {}? Else ", either(meant, "--set ", "=..."));
}

/// What is wrong although all words are known. CLI11 begins its own message with the name of the option.
Complaint misused(const CLI::App& command, const CLI::ParseError& error) {
    const std::string text = error.what();
    constexpr std::string_view not_a_flag = "Could not convert: ";  // a value given to an option that takes none
    const bool has_value = text.starts_with(not_a_flag);
    const std::string named = has_value ? text.substr(not_a_flag.size()) : text;
    const std::string option = named.substr(0, named.find_first_of(": "));
    const std::string see = see_help_of(command);
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
        return {.where = "command line",
                .problem = fmt::format("{} is missing", option),
                .why = fmt::format("`{}` needs it", called(command)),
                .remedy = fmt::format("give it, or {}", see)};
    }
    if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
        return {.where = "command line",
                .problem = text.substr(0, text.find('\n')),
                .why = "the two contradict each other",
                .remedy = fmt::format("leave one of them out, or {}", see)};
    }
    if (has_value) {
        return {.where = "command line",
                .problem = fmt::format("{} is given a value", option),
                .why = "it takes none",
                .remedy = fmt::format("leave the value out, or {}", see)};
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        const bool again = text.find("At Most") != std::string::npos;
        return {.where = "command line",
                .problem = fmt::format("{} is given {}", option, again ? "more than once" : "without a value"),
                .why = "it takes one value",
                .remedy = fmt::format("give it {}, or {}", again ? "once" : "one", see)};
    }
    return {.where = "command line",
            .problem = text.substr(0, text.find('\n')),
            .why = "this value is not accepted",
            .remedy = see};
}

}  // namespace

Complaint unknown_word(const CLI::App& command, const std::string& word) {
    const std::string see = see_help_of(command);
    const std::vector<std::string> commands = command_names(command);
    if (word.starts_with('-')) {
        const std::string option = word.substr(0, word.find('='));
        if (const auto own = option_names(command); std::ranges::find(own, option) != own.end()) {
            return {.where = "command line",
                    .problem = fmt::format("{} stands before the command", option),
                    .why = fmt::format("it belongs to `{}`", called(command)),
                    .remedy = fmt::format("write it after `{}`", called(command))};
        }
        return {.where = "command line",
                .problem = fmt::format("unknown option {}", option),
                .why = fmt::format("`{}` does not have it", called(command)),
                .remedy = option_suggestion(command, option) + see};
    }
    if (!commands.empty()) {
        return {.where = "command line",
                .problem = fmt::format("unknown command \"{}\"", word),
                .why = fmt::format("it is none of {}", fmt::join(commands, ", ")),
                .remedy = suggestion(word, commands, "`" + called(command) + " ") + see};
    }
    return {.where = "command line",
            .problem = fmt::format("\"{}\" is one word too many", word),
            .why = fmt::format("`{}` has no place for it", called(command)),
            .remedy = fmt::format("leave it out, quote names with blanks, or {}", see)};
}

Complaint command_line_complaint(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& command = command_read(app);
    const std::vector<std::string> unknown = app.remaining(true);
    if (!unknown.empty()) {
        const auto option =
            std::ranges::find_if(unknown, [](const std::string& word) { return word.starts_with('-'); });
        return unknown_word(command, option != unknown.end() ? *option : unknown.front());
    }
    return misused(command, error);
}

std::optional<std::string> help_of_unfinished(const CLI::App& app) {
    const CLI::App& command = command_read(app);
    if (command_names(command).empty() || !app.remaining(true).empty()) return std::nullopt;
    return help_of(command);
}

std::string help_of(const CLI::App& command) {
    // CLI::App::help would explain the command that stands on the line instead.
    return command.get_formatter()->make_help(&command, called(command), CLI::AppFormatMode::Normal);
}

}  // namespace skinfit
