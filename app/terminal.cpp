#include "app/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>

#include "core/text.hpp"
#include "core/utf8.hpp"

namespace skinfit {
namespace {

constexpr std::string_view bold = "\x1b[1m";
constexpr std::string_view green = "\x1b[32m";
constexpr std::string_view yellow = "\x1b[33m";
constexpr std::string_view red = "\x1b[31m";
constexpr std::string_view plain = "\x1b[0m";

std::string painted(std::string_view colour, std::string_view text) {
    return fmt::format("{}{}{}", colour, text, plain);
}

/// Only bad news is in capitals.
bool shouts(std::string_view text) {
    return std::ranges::any_of(text, ::isupper) && std::ranges::none_of(text, ::islower);
}

std::string coloured_line(std::string_view line) {
    constexpr std::string_view verdict = "verdict: ";
    constexpr std::string_view reason = "  - ";
    if (line.starts_with(verdict)) {
        const std::string_view word = line.substr(verdict.size());
        return std::string(verdict) + painted(shouts(word) ? red : green, word);
    }
    const std::size_t colon = line.find(':');
    if (!line.starts_with(reason) || colon == std::string_view::npos) return std::string(line);
    const std::string_view name = line.substr(reason.size(), colon - reason.size());
    if (!shouts(name)) return std::string(line);
    return std::string(reason) + painted(bold, name) + std::string(line.substr(colon));
}

std::string_view environment(const char* name) {
    const char* const text = std::getenv(name);
    return text == nullptr ? "" : text;
}

}  // namespace

bool is_terminal(int descriptor) {
    return ::isatty(descriptor) != 0 && environment("TERM") != "dumb";
}

bool shows_colour(int descriptor) {
    return is_terminal(descriptor) && environment("NO_COLOR").empty();
}

std::string coloured(std::string_view report) {
    std::string text;
    while (!report.empty()) {
        const std::size_t length = std::min(report.find('\n'), report.size());
        text += coloured_line(report.substr(0, length));
        if (length < report.size()) text += '\n';
        report.remove_prefix(std::min(length + 1, report.size()));
    }
    return text;
}

void write_stderr(std::string_view text) noexcept {
    if (std::fwrite(text.data(), 1, text.size(), stderr) == text.size()) std::fflush(stderr);
}

void say_line(std::string_view text) {
    write_stderr(fmt::format("{}{}\n", is_terminal(STDERR_FILENO) ? clear_line : "", printable(text)));
}

void say_trouble(std::string_view kind, std::string_view text) {
    const std::string word = fmt::format("{}:", kind);
    const std::string_view colour = kind == "warning" ? yellow : red;
    write_stderr(fmt::format("{}{} {}\n", is_terminal(STDERR_FILENO) ? clear_line : "",
                             shows_colour(STDERR_FILENO) ? painted(colour, word) : word, printable(text)));
}

}  // namespace skinfit
