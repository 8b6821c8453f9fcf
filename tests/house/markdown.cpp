#include "tests/house/markdown.hpp"

#include "core/text.hpp"

namespace skinfit::house {

std::string without_code_blocks(std::string_view document) {
    std::string prose;
    bool code = false;
    for (const std::string_view line : split_lines(document)) {
        const bool fence = trimmed(line).starts_with("```");
        if (fence) code = !code;
        if (!fence && !code) prose.append(line);
        prose.push_back('\n');
    }
    return prose;
}

std::string without_code(std::string_view document) {
    std::string prose = without_code_blocks(document);
    bool code = false;
    for (char& c : prose) {
        const bool mark = c == '`';
        if (mark) code = !code;
        if ((code || mark) && c != '\n') c = ' ';
    }
    return prose;
}

}  // namespace skinfit::house
