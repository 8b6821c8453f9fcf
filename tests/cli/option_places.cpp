#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "app/option_limits.hpp"
#include "app/program.hpp"

namespace skinfit::test {
namespace {

using Words = std::vector<std::string>;

/// Every command that can be run, by the words that call it.
std::vector<Words> runnable(const CLI::App& app, const Words& called = {}) {
    const std::vector<const CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
    if (commands.empty()) return {called};
    std::vector<Words> all;
    for (const CLI::App* command : commands) {
        Words words = called;
        words.push_back(command->get_name());
        for (Words& each : runnable(*command, words)) all.push_back(std::move(each));
    }
    return all;
}

CLI::App& command_of(CLI::App& app, const Words& called) {
    CLI::App* command = &app;
    for (const std::string& word : called) command = command->get_subcommand(word);
    return *command;
}

/// A value that the option does not refuse: one of its words, its lowest number, else a word.
std::string value_for(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    if (type.find('|') != std::string::npos) return type.substr(0, type.find('|'));
    const std::string limits = limits_of(option);
    return limits.empty() ? "x" : limits.substr(0, limits.find(' '));
}

/// What was given to each argument of a command, by its name.
using Given = std::map<std::string, Words>;

/// The command line "skinfit CALLED WORDS", parsed and not run.
Given parsed(const Words& called, const Words& words) {
    Interrupt interrupt;
    Session session{.command_line = "", .interrupt = interrupt};
    const std::unique_ptr<CLI::App> app = make_program(session);
    CLI::App& command = command_of(*app, called);
    // Its own callback holds the fields of its options, so that it has to stay; this one ends before it runs.
    command.parse_complete_callback([] { throw CLI::Success(); });
    Words line = called;
    line.insert(line.end(), words.begin(), words.end());
    std::ranges::reverse(line);
    try {
        app->parse(line);
    } catch (const CLI::Success&) {
    }
    Given given;
    for (const CLI::Option* option : std::as_const(command).get_options()) {
        if (option->count() > 0) given[option->get_name(option->get_positional())] = option->results();
    }
    return given;
}

/// A command's positional words, and each of its options with its value.
struct Line {
    Words called;
    Words positional;
    std::vector<Words> options;
    Words needed;  ///< options that cannot be left out
};

std::vector<Line> lines() {
    Interrupt interrupt;
    Session session{.command_line = "", .interrupt = interrupt};
    const std::unique_ptr<CLI::App> app = make_program(session);
    std::vector<Line> all;
    for (const Words& called : runnable(*app)) {
        Line line{.called = called, .positional = {}, .options = {}, .needed = {}};
        for (const CLI::Option* option : std::as_const(command_of(*app, called)).get_options()) {
            if (option->get_positional()) {
                line.positional.insert(line.positional.end(), option->get_items_expected_max() > 1 ? 2 : 1,
                                       value_for(*option));
            } else if (option->get_name() != "--help") {
                Words words = {"--" + option->get_lnames().front()};
                if (option->get_items_expected_max() > 0) words.push_back(value_for(*option));
                line.options.push_back(words);
                if (option->get_required()) line.needed.insert(line.needed.end(), words.begin(), words.end());
                const bool repeats = option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
                if (repeats && words.size() == 2) line.options.push_back({words[0], "x", words[0], "y"});
            }
        }
        all.push_back(std::move(line));
    }
    return all;
}

Words joined(std::initializer_list<Words> parts) {
    Words all;
    for (const Words& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

TEST(OptionPlaces, AnOptionMeansTheSameFirstLastAndBetweenTheWordsOfEveryCommand) {
    const std::vector<Line> all = lines();
    EXPECT_GE(all.size(), 22U);
    for (const Line& line : all) {
        for (const Words& option : line.options) {
            SCOPED_TRACE(testing::PrintToString(line.called) + " " + testing::PrintToString(option));
            const bool is_needed = std::ranges::find(line.needed, option.front()) != line.needed.end();
            const Words rest = is_needed ? Words{} : line.needed;  // behind all else, wherever the one at hand stands
            const Words head(line.positional.begin(),
                             line.positional.begin() + static_cast<std::ptrdiff_t>(line.positional.size() / 2));
            const Words tail(line.positional.begin() + static_cast<std::ptrdiff_t>(line.positional.size() / 2),
                             line.positional.end());
            const Given last = parsed(line.called, joined({line.positional, option, rest}));
            EXPECT_EQ(parsed(line.called, joined({option, line.positional, rest})), last);
            EXPECT_EQ(parsed(line.called, joined({head, option, tail, rest})), last);
        }
    }
}

TEST(OptionPlaces, AListTakesOneValueEachTimeItIsGiven) {
    const Given given =
        parsed({"fit"}, {"--set", "engine=solver", "a.csv", "--free", "scale", "--set", "noise=0.01", "b.csv"});
    EXPECT_EQ(given.at("FILE"), (Words{"a.csv", "b.csv"}));
    EXPECT_EQ(given.at("--set"), (Words{"engine=solver", "noise=0.01"}));
    EXPECT_EQ(given.at("--free"), Words{"scale"});
}

}  // namespace
}  // namespace skinfit::test
