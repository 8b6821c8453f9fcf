#include "app/option_limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <optional>
#include <utility>

#include "core/json.hpp"
#include "core/text.hpp"
#include "fit/settings.hpp"

namespace skinfit {
namespace {

/// How a refusal names the option: `get_name` has none for one that the help does not show.
std::string name_of(const CLI::Option* option) {
    const std::vector<std::string>& names = option->get_lnames();
    return names.empty() ? option->get_name() : "--" + names.front();
}

/// A word as the readers of settings take it.
Json json_of(const std::string& text) {
    Json json = Json::parse(text, nullptr, false);
    if (json.is_number()) return json;
    if (const std::optional<double> number = parse_number(text)) return *number;
    return text;
}

/// `option` takes what `read` does not refuse: it gets the value and the name of the option.
template <class Read>
CLI::Option* checked(CLI::Option* option, Read read) {
    const auto check = [option, read](std::string& text) {
        read(text, name_of(option));
        return std::string();
    };
    return option->check(CLI::Validator(check, ""));
}

}  // namespace

CLI::Option* whole_number(CLI::Option* option, int lowest, int highest) {
    option->option_text(fmt::format("{} to {}", lowest, highest))->type_name("N");
    return checked(option, [lowest, highest](std::string& text, const std::string& where) {
        // CLI11 would take 010 for octal.
        text = fmt::to_string(
            read_count(json_of(text), static_cast<std::uint64_t>(lowest), static_cast<std::uint64_t>(highest), where));
    });
}

CLI::Option* number(CLI::Option* option, double lowest, double highest, const std::string& unit) {
    option->option_text(fmt::format("{} to {}", lowest, highest))->type_name(unit);
    return checked(option, [lowest, highest](const std::string& text, const std::string& where) {
        (void)read_number(json_of(text), {lowest, highest}, where);
    });
}

std::string choices(std::span<const std::string_view> words) {
    return fmt::format("{}", fmt::join(words, "|"));
}

CLI::Option* one_of(CLI::Option* option, const std::vector<std::string_view>& words) {
    option->type_name(choices(words));
    return checked(
        option, [words](const std::string& text, const std::string& where) { (void)read_choice(text, words, where); });
}

CLI::Option* repeated(CLI::Option* option) {
    // CLI11 takes a list for one that goes on until the next option.
    return option->expected(1)->take_all()->allow_extra_args(false);
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
