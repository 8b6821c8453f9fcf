#include "measurements/jcamp_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/limits.hpp"
#include "measurements/words.hpp"

namespace skinfit {

const JcampRecord* JcampBlock::record(std::string_view label) const {
    const auto found = records_.find(label);
    return found == records_.end() ? nullptr : &found->second;
}

std::string JcampBlock::text(std::string_view label) const {
    const JcampRecord* const found = record(label);
    return found == nullptr ? std::string{} : std::string(found->value());
}

double JcampBlock::number(std::string_view label, std::optional<double> otherwise) const {
    const JcampRecord* const found = record(label);
    if (found == nullptr) {
        if (otherwise) return *otherwise;
        refuse_jcamp(source_, line_of("TITLE"), fmt::format("##{}= is missing", label), "the block needs it",
                     "add it, or export the spectrum again");
    }
    std::optional<double> number = parse_number(found->value());
    if (!number) number = parse_number(with_decimal_points(found->value()));
    if (!number || !std::isfinite(*number)) {
        refuse_jcamp(source_, found->line(), fmt::format("##{}= is {}", label, in_quotes(found->value())),
                     "a number is needed", "correct it, or export the spectrum again");
    }
    return *number;
}

bool JcampBlock::has_decimal_commas() const {
    static constexpr std::array<std::string_view, 11> numbers = {
        "FIRSTX", "LASTX", "FIRSTY", "DELTAX", "XFACTOR", "YFACTOR", "MINX", "MAXX", "MINY", "MAXY", "RESOLUTION"};
    return std::ranges::any_of(numbers, [this](std::string_view label) {
        const std::string value = text(label);
        return std::ranges::count(value, ',') == 1 && parse_number(with_decimal_points(value));
    });
}

std::size_t JcampBlock::line_of(std::string_view label) const {
    const JcampRecord* const found = record(label);
    return found != nullptr ? found->line() : records_.find("TITLE")->second.line();
}

std::string normalised_label(std::string_view label) {
    std::string text;
    for (const char c : label) {
        if (std::string_view(" -/_\t").find(c) != std::string_view::npos) continue;
        text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return text;
}

std::string_view without_jcamp_comment(std::string_view line) {
    return trimmed(line.substr(0, line.find("$$")));
}

std::string with_decimal_points(std::string_view line) {
    std::string text(line);
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        if (text[i] == ',' && is_digit(text[i - 1]) && is_digit(text[i + 1])) text[i] = '.';
    }
    return text;
}

std::vector<JcampBlock> jcamp_blocks(std::string_view text, const std::string& source) {
    std::vector<JcampBlock> blocks;
    std::vector<std::size_t> open;
    JcampRecord* last = nullptr;
    std::size_t number = 0;
    LineReader reader(text);
    while (const auto whole = reader.next()) {
        ++number;
        refuse_long_line(whole->size(), number, source);
        const std::string_view line = without_jcamp_comment(*whole);
        const std::size_t equals = line.find('=');
        if (!line.starts_with("##") || equals == std::string_view::npos) {
            if (last != nullptr && !line.empty()) last->lines.push_back({.number = number, .text = line});
            continue;
        }
        const std::string label = normalised_label(line.substr(2, equals - 2));
        if (label == "TITLE") {
            open.push_back(blocks.size());
            blocks.emplace_back(source);
        }
        if (open.empty() && label == "END" && !blocks.empty()) continue;  // one more than there are blocks
        if (open.empty()) {
            refuse_jcamp(source, number, "stands outside a block",
                         "a block begins with ##TITLE=", "check that the file is complete");
        }
        last = &blocks[open.back()].add(label);
        last->lines = {{.number = number, .text = trimmed(line.substr(equals + 1))}};
        if (label != "END") continue;
        open.pop_back();
        last = nullptr;
    }
    return blocks;
}

void refuse_jcamp(const std::string& source, std::size_t line, const std::string& problem, const std::string& why,
                  const std::string& remedy) {
    throw InputError({.where = fmt::format("{}:{}", source, line), .problem = problem, .why = why, .remedy = remedy});
}

}  // namespace skinfit
