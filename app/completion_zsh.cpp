#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "app/completion_values.hpp"

namespace skinfit {
namespace {

/// "study run" as the name of a function: "study_run".
std::string as_identifier(std::string command) {
    std::ranges::replace(command, ' ', '_');
    return command;
}

/// Within single quotes, where brackets and colons have a meaning to `_arguments` and `_describe`.
std::string zsh_quotes(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
        escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return escaped;
}

std::string action_of(const OptionWords& option, const CompletedNames& names) {
    const OfferedValues values = offered_values(option, names);
    switch (values.kind) {
        case OfferedValues::Kind::nothing:
            return " ";
        case OfferedValues::Kind::files:
            return "_files";
        case OfferedValues::Kind::folders:
            return "_files -/";
        case OfferedValues::Kind::words:
            return fmt::format("({})", fmt::join(values.words, " "));
        case OfferedValues::Kind::assignments:
            return fmt::format("compadd -S= {}", fmt::join(values.words, " "));
    }
    return " ";
}

/// One specification of `_arguments`.
std::string specification(const OptionWords& option, const CompletedNames& names) {
    const std::string value =
        option.argument.empty() ? "" : fmt::format(":{}:{}", zsh_quotes(option.argument), action_of(option, names));
    if (!option.names.empty()) {
        return fmt::format("        '{}{}[{}]{}' \\\n", option.repeats ? "*" : "", main_name(option),
                           zsh_quotes(option.meaning), value);
    }
    return fmt::format("        '{}{}' \\\n", option.repeats ? "*" : (option.required ? "" : ":"), value);
}

std::string leaf_function(const CommandWords& command, const CompletedNames& names) {
    std::string text = fmt::format("_skinfit_{}() {{\n    _arguments -s \\\n", as_identifier(command.name));
    for (const OptionWords& option : command.options) text += specification(option, names);
    return text + "        && return\n}\n\n";
}

std::string branch_function(const CommandWords& command) {
    const std::string own = command.name.empty() ? "_skinfit" : "_skinfit_" + as_identifier(command.name);
    std::string text = fmt::format(
        "{}() {{\n    local line state\n    _arguments -C '1: :->command' '*:: :->rest'\n    case $state in\n"
        "        command)\n            local -a commands=(\n",
        own);
    std::string arms;
    for (const CommandWords& each : command.commands) {
        const std::string word = each.name.substr(command.name.empty() ? 0 : command.name.size() + 1);
        text += fmt::format("                '{}:{}'\n", word, zsh_quotes(each.meaning));
        arms += fmt::format("                {}) _skinfit_{} ;;\n", word, as_identifier(each.name));
    }
    return text + "            )\n            _describe command commands\n            ;;\n        rest)\n" +
           "            case $line[1] in\n" + arms + "            esac\n            ;;\n    esac\n}\n\n";
}

std::string functions_of(const CommandWords& command, const CompletedNames& names) {
    if (command.commands.empty()) return leaf_function(command, names);
    std::string text;
    for (const CommandWords& each : command.commands) text += functions_of(each, names);
    return text + branch_function(command);
}

}  // namespace

std::string zsh_completion(const CommandWords& program, const CompletedNames& names) {
    return "#compdef skinfit\n\n" + functions_of(program, names) +
           "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _skinfit \"$@\"; else compdef _skinfit skinfit; fi\n";
}

}  // namespace skinfit
