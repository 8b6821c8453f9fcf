#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "app/completion_values.hpp"

namespace skinfit {
namespace {

std::string fish_quotes(std::string_view text) {
    std::string escaped = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') escaped += '\\';
        escaped += c;
    }
    return escaped + "'";
}

/// The flags of `complete` that offer values.
std::string fish_offer(const OptionWords& option, const CompletedNames& names) {
    const OfferedValues values = offered_values(option, names);
    switch (values.kind) {
        case OfferedValues::Kind::nothing:
            return option.names.empty() ? "" : " -x";
        case OfferedValues::Kind::files:
            return " -r -F";
        case OfferedValues::Kind::folders:
            return " -x -a '(__fish_complete_directories)'";
        case OfferedValues::Kind::words:
            return " -x -a " + fish_quotes(fmt::format("{}", fmt::join(values.words, " ")));
        case OfferedValues::Kind::assignments:
            return " -x -a " + fish_quotes(fmt::format("{}=", fmt::join(values.words, "= ")));
    }
    return "";
}

std::string option_line(const std::string& condition, const OptionWords& option, const CompletedNames& names) {
    std::string line = fmt::format("complete -c skinfit -n {}", condition);
    if (option.names.empty()) {
        const std::string offered = fish_offer(option, names);
        return offered.empty() ? "" : line + offered + "\n";
    }
    for (const std::string& name : option.names) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (!option.argument.empty()) line += fish_offer(option, names);
    return line + " -d " + fish_quotes(option.meaning) + "\n";
}

std::string lines_of(const CommandWords& command, const CompletedNames& names) {
    const std::string condition = fish_quotes(command.name.empty() ? "__skinfit_at" : "__skinfit_at " + command.name);
    std::string text;
    for (const OptionWords& option : command.options) text += option_line(condition, option, names);
    for (const CommandWords& each : command.commands) {
        const std::string word = each.name.substr(command.name.empty() ? 0 : command.name.size() + 1);
        text += fmt::format("complete -c skinfit -n {} -a {} -d {}\n",
                            fish_quotes(command.name.empty() ? "__skinfit_only" : "__skinfit_only " + command.name),
                            word, fish_quotes(each.meaning));
        text += lines_of(each, names);
    }
    return text;
}

constexpr std::string_view fish_beginning = R"(# fish completion for skinfit

# Whether the words typed so far begin with these, after the program's name.
function __skinfit_at
    set -l words (commandline -opc)[2..-1]
    set -l wanted (count $argv)
    test $wanted -eq 0; and return 0
    test (count $words) -ge $wanted; and test "$words[1..$wanted]" = "$argv"
end

# Whether they are these and no others.
function __skinfit_only
    test (count (commandline -opc)) -eq (math (count $argv) + 1); and __skinfit_at $argv
end

complete -c skinfit -f
)";

}  // namespace

std::string fish_completion(const CommandWords& program, const CompletedNames& names) {
    return std::string(fish_beginning) + lines_of(program, names);
}

}  // namespace skinfit
