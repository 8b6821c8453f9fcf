#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/completion_values.hpp"

namespace skinfit {
namespace {

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

/// The lines that offer values.
std::string bash_offer(const OptionWords& option, const CompletedNames& names) {
    const OfferedValues values = offered_values(option, names);
    switch (values.kind) {
        case OfferedValues::Kind::nothing:
            return "";
        case OfferedValues::Kind::files:
            return "_skinfit_files";
        case OfferedValues::Kind::folders:
            return "_skinfit_folders";
        case OfferedValues::Kind::words:
            return fmt::format("_skinfit_words \"{}\"", joined(values.words));
        case OfferedValues::Kind::assignments:
            return fmt::format("_skinfit_keys \"{}\"", joined(values.words));
    }
    return "";
}

/// One arm of the `case` over the command.
std::string command_arm(const CommandWords& command, const CompletedNames& names) {
    std::vector<std::string> options;
    std::string arms;
    std::string positional = ":";
    for (const OptionWords& option : command.options) {
        if (option.names.empty()) {
            const std::string offered = bash_offer(option, names);
            if (!offered.empty()) positional = offered;
            continue;
        }
        options.push_back(main_name(option));
        if (option.argument.empty()) continue;
        arms += fmt::format("                {}) {}; return ;;\n", fmt::join(option.names, "|"),
                            bash_offer(option, names).empty() ? ":" : bash_offer(option, names));
    }
    return fmt::format(
        "        \"{}\")\n            case \"$previous\" in\n{}            esac\n"
        "            if [[ \"$current\" == -* ]]; then _skinfit_words \"{}\"; else {}; fi\n            ;;\n",
        command.name, arms, joined(options), positional);
}

/// The arm of the program or a command with subcommands.
std::string branch_arm(const CommandWords& command) {
    std::vector<std::string> words;
    for (const CommandWords& each : command.commands) {
        words.push_back(each.name.substr(command.name.empty() ? 0 : command.name.size() + 1));
    }
    for (const OptionWords& option : command.options) words.push_back(main_name(option));
    return fmt::format("        \"{}\") _skinfit_words \"{}\" ;;\n", command.name, joined(words));
}

std::string arms_of(const CommandWords& command, const CompletedNames& names) {
    if (command.commands.empty()) return command_arm(command, names);
    std::string text = branch_arm(command);
    for (const CommandWords& each : command.commands) text += arms_of(each, names);
    return text;
}

constexpr std::string_view bash_beginning = R"(# bash completion for skinfit

# One of some words, or another one after those of a list.
_skinfit_words() {
    local before=""
    if [[ "$current" == *,* ]]; then before="${current%,*},"; fi
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${current##*,}")
}
_skinfit_keys() { compopt -o nospace; mapfile -t COMPREPLY < <(compgen -S = -W "$1" -- "$current"); }
_skinfit_files() { compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- "$current"); }
_skinfit_folders() { compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- "$current"); }

_skinfit() {
    local current="${COMP_WORDS[COMP_CWORD]}" previous="${COMP_WORDS[COMP_CWORD-1]}" command=""
    COMPREPLY=()
    # The shell takes "=" for a word of its own.
    if [[ "$current" == "=" ]]; then current=""; elif [[ "$previous" == "=" ]]; then previous="${COMP_WORDS[COMP_CWORD-2]}"; fi
    if [[ "${COMP_WORDS[COMP_CWORD]}" == "=" || "${COMP_WORDS[COMP_CWORD-1]}" == "=" ]] && [[ "$previous" != -* ]]; then return; fi
    if ((COMP_CWORD > 1)); then command="${COMP_WORDS[1]}"; fi
)";

}  // namespace

std::string bash_completion(const CommandWords& program, const CompletedNames& names) {
    std::vector<std::string> branches;
    for (const CommandWords& each : program.commands) {
        if (!each.commands.empty()) branches.push_back(each.name);
    }
    std::string text(bash_beginning);
    text += fmt::format(
        "    case \"$command\" in {}) if ((COMP_CWORD > 2)); then command+=\" ${{COMP_WORDS[2]}}\"; fi ;; esac\n",
        fmt::join(branches, "|"));
    text += "    case \"$command\" in\n" + arms_of(program, names) + "    esac\n}\n\n";
    return text + "complete -F _skinfit skinfit\n";
}

}  // namespace skinfit
