#include "app/command_line_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"

namespace skinfit {
namespace {

/// The command that was being read when `app` gave up, and how it is called.
struct Place {
    const CLI::App* command;
    std::string words;
};

Place place_of(const CLI::App& app) {
    Place place{&app, app.get_name()};
    while (!place.command->get_subcommands().empty()) {
        place.command = place.command->get_subcommands().front();
        place.words += " " + place.command->get_name();
    }
    return place;
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

/// The known name that `name` probably means, as the beginning of a remedy; empty where none is similar.
std::string suggestion(std::string_view name, const std::vector<std::string>& names, const std::string& form) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::optional<std::string_view> similar = similar_name(name, known);
    return similar ? fmt::format(fmt::runtime(form), *similar) : "";
}

/// What is wrong although all words are known. CLI11 begins its own message with the name of the option.
Complaint misused(const Place& place, const CLI::ParseError& error) {
    const std::string text = error.what();
    constexpr std::string_view not_a_flag = "Could not convert: ";  // a value given to an option that takes none
    const bool has_value = text.starts_with(not_a_flag);
    const std::string named = has_value ? text.substr(not_a_flag.size()) : text;
    const std::string option = named.substr(0, named.find_first_of(": "));
    const std::string see = fmt::format("see `{} --help`", place.words);
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
        return {.where = "command line",
                .problem = fmt::format("{} is missing", option),
                .why = fmt::format("`{}` needs it", place.words),
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

Complaint unknown_word(const Place& place, const std::string& word) {
    const std::string see = fmt::format("see `{} --help`", place.words);
    const std::vector<std::string> commands = command_names(*place.command);
    if (word.starts_with('-')) {
        const std::string option = word.substr(0, word.find('='));
        return {.where = "command line",
                .problem = fmt::format("unknown option {}", option),
                .why = fmt::format("`{}` does not have it", place.words),
                .remedy = suggestion(option, option_names(*place.command), "did you mean {}? Else ") + see};
    }
    if (!commands.empty()) {
        return {.where = "command line",
                .problem = fmt::format("unknown command \"{}\"", word),
                .why = fmt::format("it is none of {}", fmt::join(commands, ", ")),
                .remedy = suggestion(word, commands, "did you mean `" + place.words + " {}`? Else ") + see};
    }
    return {.where = "command line",
            .problem = fmt::format("\"{}\" is one word too many", word),
            .why = fmt::format("`{}` has no place for it", place.words),
            .remedy = fmt::format("leave it out, quote names with blanks, or {}", see)};
}

}  // namespace

Complaint command_line_complaint(const CLI::App& app, const CLI::ParseError& error) {
    const Place place = place_of(app);
    const std::vector<std::string> unknown = app.remaining(true);
    if (!unknown.empty()) {
        const auto option =
            std::ranges::find_if(unknown, [](const std::string& word) { return word.starts_with('-'); });
        return unknown_word(place, option != unknown.end() ? *option : unknown.front());
    }
    const std::vector<std::string> commands = command_names(*place.command);
    if (!commands.empty()) {
        return {.where = "command line",
                .problem = "the command is missing",
                .why = fmt::format("`{}` alone does nothing", place.words),
                .remedy = fmt::format("give one of {}, or see `{} --help`", fmt::join(commands, ", "), place.words)};
    }
    return misused(place, error);
}

}  // namespace skinfit
