#include "measurements/cells.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/csv.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace {

std::string_view without_quotes(std::string_view cell) {
    if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return cell;
    return trimmed(cell.substr(1, cell.size() - 2));
}

bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && (byte < '\t' || byte > '\r')) || byte == 0x7f;
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

}  // namespace

std::size_t find_unquoted(std::string_view text, std::string_view marks) {
    bool inside = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') inside = !inside;
        if (!inside && marks.find(text[i]) != std::string_view::npos) return i;
    }
    return std::string_view::npos;
}

std::span<const std::string_view> CellCutter::cut(std::string_view line) {
    cells_.clear();
    const bool quoted = line.find('"') != std::string_view::npos;
    if (separator_ == ' ') {
        for (std::string_view rest = trimmed(line);; rest = trimmed(rest)) {
            const auto blank = std::ranges::find_if(rest, is_blank);
            const std::size_t size =
                quoted ? find_unquoted(rest, " \t\v\f") : static_cast<std::size_t>(blank - rest.begin());
            cells_.push_back(without_quotes(rest.substr(0, size)));
            if (size >= rest.size()) return cells_;
            rest.remove_prefix(size);
        }
    }
    if (quoted) {
        for (std::string_view rest = line;;) {
            const std::size_t size = find_unquoted(rest, {&separator_, 1});
            cells_.push_back(without_quotes(trimmed(rest.substr(0, size))));
            if (size == std::string_view::npos) return cells_;
            rest.remove_prefix(size + 1);
        }
    }
    // Cells are a few characters long: a plain loop finds their ends sooner than a call of memchr does.
    const char* begin = line.data();
    const char* const line_end = begin + line.size();
    for (const char* end = begin;; ++end) {
        if (end != line_end && *end != separator_) continue;
        cells_.push_back(trimmed({begin, static_cast<std::size_t>(end - begin)}));
        if (end == line_end) return cells_;
        begin = end + 1;
    }
}

RowShape CellCutter::shape(std::string_view line) {
    if (separator_ == ' ' || line.find('"') != std::string_view::npos) {
        const std::span<const std::string_view> cells = cut(line);
        return {.width = cells.size(), .filled = filled_width(cells), .first = cells.front()};
    }
    const auto separators = static_cast<std::size_t>(std::ranges::count(line, separator_));
    const std::size_t last =
        line.find_last_not_of(separator_ == '\t' ? " \t\v\f" : std::string{' ', '\t', '\v', '\f', separator_});
    const std::size_t empty_at_end = last == std::string_view::npos
                                         ? separators + 1
                                         : static_cast<std::size_t>(std::ranges::count(line.substr(last), separator_));
    return {.width = separators + 1,
            .filled = separators + 1 - empty_at_end,
            .first = trimmed(line.substr(0, line.find(separator_)))};
}

std::size_t filled_width(std::span<const std::string_view> cells) {
    std::size_t width = cells.size();
    while (width > 0 && cells[width - 1].empty()) --width;
    return width;
}

std::string unescaped(std::string_view cell) {
    std::string text(without_text_mark(cell));
    for (std::size_t i = text.find("\"\""); i != std::string::npos; i = text.find("\"\"", i + 1)) text.erase(i, 1);
    return text;
}

void refuse_binary(std::string_view text, const std::string& source) {
    // Block by block without a way out: the compiler makes it a few instructions for 16 bytes at once.
    constexpr std::size_t block_size = 4096;
    std::size_t at = 0;
    for (; at < text.size(); at += block_size) {
        const std::string_view block = text.substr(at, block_size);
        unsigned found = 0;
        for (const char c : block) found |= static_cast<unsigned>(is_control(c));
        if (found != 0) break;
    }
    if (at >= text.size()) return;
    const auto byte = std::ranges::find_if(text.substr(at), is_control);
    const auto before = static_cast<std::size_t>(byte - text.begin());
    throw InputError({.where = fmt::format("{}:{}", source, split_lines(text.substr(0, before + 1)).size()),
                      .problem = fmt::format("holds the control byte 0x{:02x}", static_cast<unsigned char>(*byte)),
                      .why = "plain text is needed; this is a binary, spreadsheet or UTF-16 file",
                      .remedy = "export it as plain text or CSV in UTF-8"});
}

}  // namespace skinfit
