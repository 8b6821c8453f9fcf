#include "app/option_limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "core/input_error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace {

std::optional<long long> parsed_whole(const std::string& text) {
    long long number = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && last == end ? std::optional(number) : std::nullopt;
}

/// A value as messages show it: words in quotes, numbers without.
std::string shown_value(const std::string& text) {
    return parse_number(text) ? text : shown(text);
}

[[noreturn]] void refuse(const CLI::Option* option, const std::string& text, const std::string& why,
                         const std::string& remedy) {
    // `get_name` has none for an option that the help does not show.
    const std::vector<std::string>& names = option->get_lnames();
    throw InputError({.where = names.empty() ? option->get_name() : "--" + names.front(),
                      .problem = fmt::format("{} cannot be used", shown_value(text)),
                      .why = why,
                      .remedy = remedy});
}

}  // namespace

CLI::Option* whole_number(CLI::Option* option, int lowest, int highest) {
    option->option_text(fmt::format("{} to {}", lowest, highest));
    const auto check = [option, lowest, highest](std::string& text) {
        const std::optional<long long> number = parsed_whole(text);
        if (!number || *number < lowest || *number > highest) {
            const bool is_number = parse_number(text).has_value();
            refuse(option, text, is_number ? (number ? "out of range" : "it is no whole number") : "a number is needed",
                   fmt::format("give a whole number from {} to {}", lowest, highest));
        }
        text = fmt::to_string(*number);  // CLI11 takes 010 for octal
        return std::string();
    };
    return option->type_name("N")->check(CLI::Validator(check, ""));
}

CLI::Option* number(CLI::Option* option, double lowest, double highest, const std::string& unit) {
    option->option_text(fmt::format("{} to {}", lowest, highest));
    const auto check = [option, lowest, highest](std::string& text) {
        const std::optional<double> number = parse_number(text);
        if (!number || !(*number >= lowest && *number <= highest)) {
            refuse(option, text, number ? "out of range" : "a number is needed",
                   fmt::format("give a number from {} to {}", lowest, highest));
        }
        return std::string();
    };
    return option->type_name(unit)->check(CLI::Validator(check, ""));
}

CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& words) {
    const auto check = [option, words](std::string& text) {
        if (std::ranges::find(words, text) == words.end()) {
            refuse(option, text, fmt::format("one of {} is needed", fmt::join(words, ", ")), "give one of these");
        }
        return std::string();
    };
    return option->type_name(fmt::format("{}", fmt::join(words, "|")))->check(CLI::Validator(check, ""));
}

std::string limits_of(const CLI::Option& option) {
    return option.get_option_text();  // of no other use: CLI11's own form of the help would print it
}

std::string HelpForm::make_option_opts(const CLI::Option* option) const {
    if (option->get_type_size() == 0) return "";
    // A positional argument is its own placeholder.
    std::string text = option->get_positional() ? "" : " " + option->get_type_name();
    if (option->get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
    return text;
}

std::string HelpForm::make_option_desc(const CLI::Option* option) const {
    std::string text = option->get_description();
    for (const CLI::Option* other : option->get_excludes()) text += fmt::format("; not with {}", other->get_name());
    std::vector<std::string> notes;
    if (!limits_of(*option).empty()) notes.push_back(limits_of(*option));
    if (!option->get_default_str().empty()) notes.push_back("default: " + option->get_default_str());
    if (option->get_required() && !option->get_positional()) notes.emplace_back("needed");
    return notes.empty() ? text : fmt::format("{} ({})", text, fmt::join(notes, "; "));
}

std::string HelpForm::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    // CLI11 leaves a line for a group of options that are not shown.
    for (std::size_t at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n")) text.erase(at, 1);
    return text;
}

}  // namespace skinfit
