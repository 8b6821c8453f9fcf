#include "tests/house/source_shape.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "core/text.hpp"

namespace skinfit::house {
namespace {

std::size_t indentation(std::string_view line) {
    return std::min(line.find_first_not_of(' '), line.size());
}

bool starts_with_one_of(std::string_view text, std::span<const std::string_view> words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return text.starts_with(word); });
}

constexpr std::array<std::string_view, 7> types_and_namespaces = {"namespace", "struct", "class", "enum",
                                                                  "union",     "extern", "using"};

/// What a line says before its comment.
std::string_view code_of(std::string_view line) {
    return trimmed(line.substr(0, line.find("//")));
}

bool ends_something(std::string_view code) {
    return code.empty() || code.ends_with(';') || code.ends_with('{') || code.ends_with('}') || code.ends_with(':') ||
           code.starts_with('#') || code.starts_with("template");
}

/// The line on which the declaration begins that opens a body on line `at`.
std::size_t beginning(const std::vector<std::string_view>& lines, std::size_t at) {
    while (at > 0 && !ends_something(code_of(lines[at - 1]))) --at;
    return at;
}

/// Whether a declaration that begins with `line` and opens a body is that of a function: of a namespace at the margin,
/// of a class one step in.
bool is_function(std::string_view line) {
    const std::size_t indent = indentation(line);
    const std::string_view text = line.substr(indent);
    constexpr std::array<std::string_view, 9> statements = {"if (",     "for (",  "while (", "switch (", "} else",
                                                            "default:", "return", "const ",  "do {"};
    if (indent != 0 && indent != 4) return false;
    if (starts_with_one_of(text, types_and_namespaces) || (indent == 4 && starts_with_one_of(text, statements))) {
        return false;
    }
    const bool is_value = text.substr(0, text.find('(')).find('=') != std::string_view::npos;
    return text.find('(') != std::string_view::npos && !is_value;
}

/// The lines of a header, one after the other, and what is known when one is reached.
class HeaderReading {
public:
    void read(std::string_view line) {
        const std::string_view code = code_of(line);
        follow_classes(line, code);
        if (trimmed(line).empty()) is_explained_ = false;
        if (trimmed(line).starts_with("///")) is_explained_ = true;
        if (line.starts_with("namespace skinfit") && is_explained_) is_explained_as_a_whole_ = true;
        if (code.empty()) return;
        if (begins_declaration(line, code) && !is_explained_ && line.find("///<") == std::string_view::npos) {
            undocumented_.emplace_back(trimmed(line));
        }
        is_continued_ = !ends_something(code);
    }

    [[nodiscard]] std::vector<std::string> undocumented() const {
        return is_explained_as_a_whole_ ? std::vector<std::string>() : undocumented_;
    }

private:
    void follow_classes(std::string_view line, std::string_view code) {
        const bool is_type = line.starts_with("class ") || line.starts_with("struct ");
        if (is_type && code.ends_with('{')) is_in_class_ = true;
        if (is_type) is_public_ = line.starts_with("struct ");
        if (line.starts_with('}')) is_in_class_ = false;
        if (code == "public:") is_public_ = true;
        if (code == "private:" || code == "protected:") is_public_ = false;
    }

    [[nodiscard]] bool begins_declaration(std::string_view line, std::string_view code) const {
        constexpr std::array<std::string_view, 10> others = {
            "#", "}", "namespace", "template", "public:", "private:", "friend", "extern", "HWY_BEFORE", "HWY_AFTER"};
        if (is_continued_ || starts_with_one_of(code, others)) return false;
        if (indentation(line) == 0) return !is_declared_forward(code);
        return indentation(line) == 4 && is_in_class_ && is_public_ && declares_member(code);
    }

    static bool is_declared_forward(std::string_view code) {
        return (code.starts_with("class ") || code.starts_with("struct ")) && code.ends_with(';');
    }

    static bool declares_member(std::string_view code) {
        return code.starts_with("[[nodiscard]]") && code.find("operator") == std::string_view::npos;
    }

    bool is_explained_ = false;
    bool is_explained_as_a_whole_ = false;
    bool is_continued_ = false;
    bool is_in_class_ = false;
    bool is_public_ = true;
    std::vector<std::string> undocumented_;
};

}  // namespace

std::vector<FunctionLength> functions_in(std::string_view source) {
    const std::vector<std::string_view> lines = split_lines(source);
    std::vector<FunctionLength> functions;
    for (std::size_t open = 0; open < lines.size(); ++open) {
        if (!lines[open].ends_with('{')) continue;
        const std::size_t first = beginning(lines, open);
        if (!is_function(lines[first])) continue;
        const std::string close = std::string(indentation(lines[first]), ' ') + "}";
        std::size_t last = open + 1;
        while (last < lines.size() && !lines[last].starts_with(close)) ++last;
        functions.push_back(
            {.first_line = std::string(trimmed(lines[first])), .lines = static_cast<int>(last - first) + 1});
    }
    return functions;
}

std::vector<std::string> undocumented_in(std::string_view header) {
    HeaderReading reading;
    for (const std::string_view line : split_lines(header)) reading.read(line);
    return reading.undocumented();
}

std::vector<std::string> types_in(std::string_view header) {
    constexpr std::array<std::string_view, 5> beginnings = {"struct ", "class ", "union ", "enum class ", "using "};
    std::vector<std::string> types;
    for (const std::string_view line : split_lines(header)) {
        for (const std::string_view beginning : beginnings) {
            if (!line.starts_with(beginning)) continue;
            const std::string_view rest = line.substr(beginning.size());
            const auto end = std::ranges::find_if(
                rest, [](char c) { return c != '_' && std::isalnum(static_cast<unsigned char>(c)) == 0; });
            if (end == rest.end() || *end == ' ') types.emplace_back(rest.begin(), end);
        }
    }
    return types;
}

}  // namespace skinfit::house
