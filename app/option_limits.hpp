#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the value of an option may be. It stands in the help, and another value is refused in the words in which that
/// of a setting is: `--threads: 0 cannot be used (out of range); give a whole number from 1 to 1024`.
namespace skinfit {

/// The value is a whole number from `lowest`, 0 or more, to `highest`; the help calls it N.
CLI::Option* whole_number(CLI::Option* option, int lowest, int highest);

/// The value is a number from `lowest` to `highest`; the help calls it `unit`.
CLI::Option* number(CLI::Option* option, double lowest, double highest, const std::string& unit);

/// `words` as the help names a value that is one of them.
[[nodiscard]] std::string choices(std::span<const std::string_view> words);

/// The value is one of `words`, which outlive the option.
CLI::Option* one_of(CLI::Option* option, const std::vector<std::string_view>& words);

/// The option takes one value and may be given again; what follows the value is not its own. The field is a list.
CLI::Option* repeated(CLI::Option* option);

/// What `whole_number` and `number` allow, as in "1 to 1024"; else empty.
[[nodiscard]] std::string limits_of(const CLI::Option& option);

/// The help of all commands: an option, its value, what it does, its limits and its default.
class HelpForm : public CLI::Formatter {
public:
    [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
    [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;
    [[nodiscard]] std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace skinfit
