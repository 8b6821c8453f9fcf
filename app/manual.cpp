#include "app/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "core/text.hpp"
#include "core/version.hpp"

namespace skinfit {
namespace {

/// `text` so that roff prints it as it is: backslashes and dashes are its own letters, and a line must not begin with
/// one of its requests.
std::string literal(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        const bool begins_line = escaped.empty() || escaped.back() == '\n';
        if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
        if (c == '\\') {
            escaped += "\\e";
        } else if (c == '-') {
            escaped += "\\-";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string bold(std::string_view text) {
    return fmt::format("\\fB{}\\fR", literal(text));
}
std::string slanted(std::string_view text) {
    return fmt::format("\\fI{}\\fR", literal(text));
}

std::string option_text(const OptionWords& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.names) names.push_back(bold(name));
    std::string head = fmt::format("{}", fmt::join(names, ", "));
    if (!option.choices.empty()) {
        head += fmt::format(" {}", slanted(fmt::format("{}", fmt::join(option.choices, "|"))));
    } else if (!option.argument.empty()) {
        head += (names.empty() ? "" : " ") + slanted(option.argument);
    }
    if (names.empty() && option.repeats) head += " ...";
    std::string text = fmt::format(".TP\n{}\n{}", head, literal(option.meaning));
    if (!option.default_text.empty()) text += fmt::format(" (default: {})", literal(option.default_text));
    if (option.required && !option.names.empty()) text += " (needed)";
    return text + "\n";
}

std::string usage(const CommandWords& command) {
    std::string text = fmt::format(".B skinfit {}\n", literal(command.name));
    text += "[\\fIoptions\\fR]\n";
    for (const OptionWords& option : command.options) {
        if (!option.names.empty()) continue;
        const std::string name = slanted(option.argument) + (option.repeats ? " ..." : "");
        text += option.required ? name + "\n" : fmt::format("[{}]\n", name);
    }
    return text;
}

/// The footer of a help, line by line.
std::string footer_text(const std::string& footer) {
    if (footer.empty()) return "";
    return fmt::format(".PP\n.nf\n{}\n.fi\n", literal(footer));
}

std::string command_text(const CommandWords& command) {
    std::string text = fmt::format(".SS skinfit {}\n.PP\n{}.PP\n{}.\n", literal(command.name), usage(command),
                                   literal(command.meaning));
    for (const OptionWords& option : command.options) {
        if (option.names.empty()) text += option_text(option);
    }
    for (const OptionWords& option : command.options) {
        if (!option.names.empty() && option.names.back() != "--help") text += option_text(option);
    }
    return text + footer_text(command.footer);
}

constexpr std::string_view closing = R"(.SH EXIT STATUS
.TP
0
done; of a fit: a consistent result
.TP
1
done, but a fit is suspect or failed, a study is not whole, or a validation has not passed
.TP
2
bad input: the message says where, what, why, and what to do
.TP
3
an internal error
.TP
128 + N
ended by signal N, as by Ctrl\-C (130)
.SH ENVIRONMENT
.TP
.B SKINFIT_CACHE_DIR
the folder in which recorded walks are kept; without it
.I ~/.cache/skinfit
.TP
.B NO_COLOR
no colours, where it is set to anything but the empty text; there are none either where the output is no terminal
.SH NOTES
Research software, not a medical device.
)";

}  // namespace

std::string manual_page(const CommandWords& program) {
    std::string text = fmt::format(".TH SKINFIT 1 \"\" \"skinfit {}\" \"User Commands\"\n", version);
    text += ".SH NAME\nskinfit \\- estimate skin biology from measured light\n";
    text += ".SH SYNOPSIS\n.B skinfit\n\\fIcommand\\fR [\\fIoptions\\fR] [\\fIfiles\\fR]\n";
    text += fmt::format(".SH DESCRIPTION\n{}\n", literal(program.meaning));
    text += literal(
        "It finds the melanosome fraction, blood fractions, oxygen saturation, bilirubin and other parameters of skin "
        "that explain a measured reflectance or transmittance spectrum, says how sure it is, and says so when the "
        "spectrum cannot tell.\n");
    text += fmt::format(".PP\n{}\n", literal("Every command explains itself with --help."));
    text += ".SH COMMANDS\n";
    for (const CommandWords& command : leaves(program)) text += command_text(command);
    return text + std::string(closing);
}

}  // namespace skinfit
