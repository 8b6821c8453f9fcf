#include "measurements/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

void refuse_binary(std::string_view text, const std::string& source) {
    const auto is_binary = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte < 0x20 || byte == 0x7f) && std::string_view("\t\n\v\f\r").find(c) == std::string_view::npos;
    };
    const auto found = std::ranges::find_if(text, is_binary);
    if (found == text.end()) return;
    const auto before = static_cast<std::size_t>(found - text.begin());
    throw InputError({.where = fmt::format("{}:{}", source, split_lines(text.substr(0, before + 1)).size()),
                      .problem = fmt::format("holds the control byte 0x{:02x}", static_cast<unsigned char>(*found)),
                      .why = "plain text is needed; this is a binary, spreadsheet or UTF-16 file",
                      .remedy = "export it as plain text or CSV in UTF-8"});
}

/// Where the first of `marks` outside double quotes is, or npos.
std::size_t find_unquoted(std::string_view text, std::string_view marks) {
    bool inside = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') inside = !inside;
        if (!inside && marks.find(text[i]) != std::string_view::npos) return i;
    }
    return std::string_view::npos;
}

std::string_view without_quotes(std::string_view cell) {
    if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return cell;
    return trimmed(cell.substr(1, cell.size() - 2));
}

std::vector<std::string_view> split_cells(std::string_view line, char separator) {
    const bool blanks = separator == ' ';
    const std::string_view marks = blanks ? std::string_view(" \t\v\f") : std::string_view(&separator, 1);
    std::vector<std::string_view> cells;
    for (std::string_view rest = blanks ? trimmed(line) : line;;) {
        const std::size_t end = find_unquoted(rest, marks);
        cells.push_back(without_quotes(trimmed(rest.substr(0, end))));
        if (end == std::string_view::npos) return cells;
        rest.remove_prefix(end + 1);
        if (blanks) rest = trimmed(rest);
    }
}

/// A line of the table, before it is taken apart.
struct Line {
    std::size_t number;
    std::string_view text;
};

char find_separator(const std::vector<Line>& lines) {
    constexpr std::array candidates{'\t', ';', ','};
    std::array<std::size_t, candidates.size()> occurrences{};
    for (const Line& line : lines) {
        const std::string_view text = trimmed(line.text);
        if (!starts_like_a_number(text.substr(text.starts_with('"') ? 1 : 0))) continue;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (text.find(candidates[i]) != std::string_view::npos) ++occurrences[i];
        }
    }
    const auto most = std::ranges::max_element(occurrences);
    return *most == 0 ? ' ' : candidates[static_cast<std::size_t>(most - occurrences.begin())];
}

bool is_header(const Row& row) {
    const auto is_word = [](std::string_view cell) { return !is_missing(cell) && !starts_like_a_number(cell); };
    return row.cells.front().empty() ? std::ranges::any_of(row.cells, is_word) : is_word(row.cells.front());
}

/// Cells up to the last that holds text.
std::size_t filled_width(const Row& row) {
    const auto last =
        std::find_if(row.cells.rbegin(), row.cells.rend(), [](std::string_view cell) { return !cell.empty(); });
    return static_cast<std::size_t>(row.cells.rend() - last);
}

/// The columns that the first line has and some line fills: separators at the end of every line add none.
std::size_t table_width(const std::vector<Row>& rows) {
    const auto widest = std::ranges::max_element(rows, {}, filled_width);
    return std::min(rows.front().cells.size(), filled_width(*widest));
}

void refuse_words(const Columns& columns) {
    for (const Row& row : columns.rows) {
        const std::string_view first = row.cells.front();
        if (is_missing(first) || starts_like_a_number(first)) continue;
        throw InputError({.where = at_line(columns, row.line),
                          .problem = fmt::format("starts with the word {}", in_quotes(first)),
                          .why = "below comments and one header line, every line is a wavelength and its values",
                          .remedy = "delete such lines or put # in front of them"});
    }
}

void refuse_other_widths(const Columns& columns, std::size_t first_line) {
    for (const Row& row : columns.rows) {
        const std::size_t found = row.cells.size() < columns.width ? row.cells.size() : filled_width(row);
        if (row.cells.size() >= columns.width && found <= columns.width) continue;
        throw InputError({.where = at_line(columns, row.line),
                          .problem = fmt::format("has {} field{}", found, found == 1 ? "" : "s"),
                          .why = fmt::format("line {} has {}", first_line, columns.width),
                          .remedy =
                              "give every line one field per column, put names with separators in double quotes and "
                              "# before a title, and write decimal points, not commas"});
    }
    if (columns.width < 2) {
        throw InputError({.where = at_line(columns, first_line),
                          .problem = "has one column",
                          .why = "a wavelength and a value are needed",
                          .remedy = "separate columns by commas, semicolons, tabs or blanks"});
    }
}

/// True for what decimal commas leave behind when lines of blanks are split at commas.
bool is_two_numbers(std::string_view cell) {
    const std::size_t blank = cell.find_first_of(" \t");
    return blank != std::string_view::npos && parse_number(cell.substr(0, blank)) &&
           parse_number(trimmed(cell.substr(blank)));
}

/// Lines split at commas that may have been decimal: `400,5 0,12`, and `400,0,12` where no header counts the columns.
void refuse_decimal_commas(const Columns& columns) {
    if (columns.separator != ',') return;
    const auto some_cell = [&columns](auto&& holds) {
        return std::ranges::find_if(columns.rows,
                                    [&](const Row& row) { return std::ranges::any_of(row.cells, holds); });
    };
    const auto has_point = [](std::string_view cell) { return cell.find('.') != std::string_view::npos; };
    auto suspect = some_cell(is_two_numbers);
    if (columns.names.empty() && columns.width > 2 && some_cell(has_point) == columns.rows.end()) {
        suspect = columns.rows.begin();
    }
    if (suspect == columns.rows.end()) return;
    throw InputError({.where = at_line(columns, suspect->line),
                      .problem = "its commas may be decimal marks or separators",
                      .why = "decimal commas are understood between tabs or semicolons only",
                      .remedy = "write decimal points, or name the columns in a header line if the commas separate"});
}

std::string name_of(std::string_view cell) {
    std::string name(cell);
    for (std::size_t i = name.find("\"\""); i != std::string::npos; i = name.find("\"\"", i + 1)) name.erase(i, 1);
    return name;
}

}  // namespace

Columns split_columns(std::string_view text, const std::string& source) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    refuse_binary(text, source);

    Columns columns;
    columns.source = source;
    std::vector<Line> lines;
    std::size_t number = 0;
    for (const std::string_view line : split_lines(text)) {
        ++number;
        const std::string_view content = line.substr(0, find_unquoted(line, "#"));
        if (!trimmed(content).empty()) {
            lines.push_back({.number = number, .text = content});
        } else if (content.size() < line.size()) {
            columns.comments.push_back({.line = number, .text = trimmed(line.substr(content.size() + 1))});
        }
    }

    columns.separator = find_separator(lines);
    for (const Line& line : lines) {
        Row row{.line = line.number, .cells = split_cells(line.text, columns.separator)};
        if (filled_width(row) > 0) columns.rows.push_back(std::move(row));
    }
    const bool headed = !columns.rows.empty() && is_header(columns.rows.front());
    if (columns.rows.size() == (headed ? 1 : 0)) {
        throw InputError({.where = source,
                          .problem = trimmed(text).empty() ? "is empty" : "holds no numbers",
                          .why = "lines of a wavelength and its values are needed",
                          .remedy = "check that the file is complete"});
    }
    columns.width = table_width(columns.rows);
    const std::size_t first_line = columns.rows.front().line;
    if (headed) {
        columns.header_line = first_line;
        for (std::size_t c = 0; c < columns.width; ++c) columns.names.push_back(name_of(columns.rows.front().cells[c]));
        columns.rows.erase(columns.rows.begin());
    }
    refuse_words(columns);
    refuse_decimal_commas(columns);
    refuse_other_widths(columns, first_line);
    return columns;
}

std::string at_line(const Columns& columns, std::size_t line) {
    return fmt::format("{}:{}", columns.source, line);
}

}  // namespace skinfit
