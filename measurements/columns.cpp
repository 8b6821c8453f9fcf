#include "measurements/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/abscissa.hpp"
#include "measurements/cells.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/header.hpp"
#include "measurements/limits.hpp"
#include "measurements/table_block.hpp"
#include "measurements/table_refusals.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

void check_column_count(const Columns& columns) {
    if (columns.width <= most_columns) return;
    throw InputError({.where = at_line(columns, columns.rows.front().line),
                      .problem = fmt::format("has {} columns", columns.width),
                      .why = fmt::format("at most {} are read", most_columns),
                      .remedy = "split the file, or check that it is one of spectra"});
}

/// What the rows look like once they are cut.
struct Shape {
    std::size_t first_width = 0;  ///< cells of the first row
    std::size_t widest = 0;       ///< filled cells of the widest row
    bool same_width = true;       ///< all rows have as many cells as the first
    bool has_points = false;
    std::optional<Row> word;                 ///< the first row that starts with a word
    std::optional<std::size_t> two_numbers;  ///< the first line with a cell such as `5 0.12`
};

/// True for what decimal commas leave behind when lines of blanks are split at commas.
bool is_two_numbers(std::string_view cell) {
    const std::size_t blank = cell.find_first_of(" \t");
    return blank != std::string_view::npos && parse_number(cell.substr(0, blank)) &&
           parse_number(trimmed(cell.substr(blank)));
}

Shape shape_of(std::span<const Row> rows, const TableForm& form) {
    const char separator = form.separator;
    Shape shape;
    CellCutter cutter(separator);
    for (const Row& row : rows) {
        RowShape found = cutter.shape(row.text);
        if (form.first > 0 && found.filled > form.first) found.first = cutter.cut(row.text)[form.first];
        if (shape.first_width == 0) shape.first_width = found.width;
        shape.same_width = shape.same_width && found.width == shape.first_width;
        shape.widest = std::max(shape.widest, found.filled);
        if (!shape.word && !starts_like_a_number(found.first) && !is_missing(found.first)) shape.word = row;
        if (separator != ',') continue;
        shape.has_points = shape.has_points || row.text.find('.') != std::string_view::npos;
        const bool has_blanks =
            row.text.find(' ') != std::string_view::npos || row.text.find('\t') != std::string_view::npos;
        if (!shape.two_numbers && has_blanks && std::ranges::any_of(cutter.cut(row.text), is_two_numbers)) {
            shape.two_numbers = row.line;
        }
    }
    return shape;
}

/// Lines split at commas that may have been decimal: `400,5 0,12`, and `400,0,12` where no header counts the columns.
void refuse_decimal_commas(const Columns& columns, const Shape& shape) {
    if (columns.separator != ',') return;
    const bool uncounted = columns.names.empty() && columns.width > 2 && !shape.has_points;
    if (!uncounted && !shape.two_numbers) return;
    throw InputError({.where = at_line(columns, uncounted ? columns.rows.front().line : *shape.two_numbers),
                      .problem = "its commas may be decimal marks or separators",
                      .why = "decimal commas are understood between tabs or semicolons only",
                      .remedy = "write decimal points, or name the columns in a header line if the commas separate"});
}

/// Throws InputError for the first row that has not as many cells as the first line, whether header or row.
void refuse_other_widths(const Columns& columns, const Shape& shape) {
    const std::size_t first_line = columns.header_line > 0 ? columns.header_line : columns.rows.front().line;
    if (!shape.same_width || shape.first_width < columns.width || shape.widest > columns.width) {
        CellCutter cutter(columns.separator);
        for (const Row& row : columns.rows) {
            const std::span<const std::string_view> cells = cutter.cut(row.text);
            const std::size_t found = cells.size() < columns.width ? cells.size() : filled_width(cells);
            if (cells.size() >= columns.width && found <= columns.width) continue;
            refuse_width(columns, row.line, found, first_line, columns.width);
        }
    }
    if (columns.width < 2) {
        throw InputError({.where = at_line(columns, first_line),
                          .problem = "has one column",
                          .why = "a wavelength and a value are needed",
                          .remedy = "separate columns by commas, semicolons, tabs or blanks"});
    }
}

/// A line right above the numbers whose first word is that of an abscissa names columns; other prose need not.
bool is_meant_as_header(std::string_view line) {
    const std::string text = lower_case(line);
    return text.starts_with("wave") || text.starts_with("nm") ||
           is_abscissa_name(text.substr(0, text.find_first_of(",;\t")));
}

/// The header of a table without one: that of its last comment above the numbers. Between blanks, prose may have as
/// many words as the table has columns; there its first must be the name of an abscissa.
void take_header_from_comment(Columns& columns) {
    const std::size_t first_row = columns.rows.front().line;
    const auto below =
        std::ranges::find_if(columns.comments, [&](const Comment& each) { return each.line > first_row; });
    if (below == columns.comments.begin()) return;
    const auto last = std::prev(below);
    if (!columns.preamble.empty() && columns.preamble.back().line > last->line) return;
    const Row row{.line = last->line, .text = last->text};
    Header header = find_header(std::span(&row, 1), columns.width, columns.separator);
    if (header.lines == 0) return;
    const bool numbers =
        std::ranges::any_of(header.names, [](const std::string& name) { return parse_number(name).has_value(); });
    const bool begins_with_abscissa = is_abscissa_name(header.names.front());
    const bool may_be_prose =
        columns.separator == ' ' || !contains(last->text, {&columns.separator, 1}) || contains(last->text, ":");
    if ((numbers && !begins_with_abscissa) || (may_be_prose && !begins_with_abscissa)) return;
    columns.names = std::move(header.names);
    columns.header_line = last->line;
    columns.comments.erase(last);
}

/// Spectra Vista's SIG files have no header: their columns are always these, the reflectance in percent (SVC HR-1024i
/// user manual, "SIG file format").
void name_sig_columns(Columns& columns) {
    constexpr std::size_t sig_columns = 4;
    if (!columns.names.empty() || columns.preamble.empty() || columns.width != sig_columns) return;
    if (!contains(columns.preamble.front().text, "Spectra Vista SIG")) return;
    columns.names = {"wavelength (nm)", "reference (radiance)", "target (radiance)", "reflectance (%)"};
}

/// Throws InputError where a slip in the first row, as in `O400,0.5`, makes a second header of it.
void refuse_slip_in_first_row(const Columns& columns, std::span<const Row> words, std::size_t width) {
    if (words.size() < 2) return;
    CellCutter cutter(columns.separator);
    const std::span<const std::string_view> cells = cutter.cut(words.back().text);
    if (is_statement_key(cells.front())) return;
    const bool has_numbers =
        std::ranges::any_of(cells.subspan(1), [](std::string_view cell) { return parse_number(cell).has_value(); });
    if (!has_numbers || find_header(words.first(words.size() - 1), width, columns.separator).lines == 0) return;
    refuse_word(columns, words.back().line, cells.front());
}

/// A header one shorter than the rows, each of which begins with its number or a quoted name: R's write.table wrote it.
bool has_row_names(const Columns& columns, std::size_t named_width, const Shape& shape) {
    if (!shape.same_width || shape.widest != shape.first_width || named_width + 1 != shape.first_width) return false;
    CellCutter cutter(columns.separator);
    for (std::size_t i = 0; i < std::min<std::size_t>(columns.rows.size(), 3); ++i) {
        const std::string_view line = trimmed(columns.rows[i].text);
        const bool counts = parse_number(cutter.cut(line).front()) == static_cast<double>(i + 1);
        if (!counts && !line.starts_with('"')) return false;
    }
    return true;
}

/// Names the columns by the last of the lines above the numbers; those above it are the preamble.
void take_words(Columns& columns, std::span<const Row> words, const Shape& shape) {
    columns.width = std::min(shape.first_width, shape.widest);
    if (words.empty()) return;
    CellCutter cutter(columns.separator);
    const std::span<const std::string_view> last = cutter.cut(words.back().text);
    const std::size_t named_width = std::min(last.size(), std::max(filled_width(last), shape.widest));
    if (named_width <= shape.first_width && named_width >= shape.widest) columns.width = named_width;
    const std::size_t unnamed = has_row_names(columns, named_width, shape) ? 1 : 0;
    refuse_slip_in_first_row(columns, words, columns.width);
    Header header = find_header(words, columns.width - unnamed, columns.separator);
    const std::optional<KeyedLine> keyed = keyed_line(words.back().text);
    const bool is_statement = is_statement_key(keyed ? keyed->key : last.front());
    if (header.line == words.back().line && is_statement) header = {};
    if (header.lines > 0 && unnamed > 0) header.names.insert(header.names.begin(), std::string{});
    if (header.lines == 0 && !is_statement && is_meant_as_header(words.back().text)) {
        header = {.lines = 1,
                  .line = words.back().line,
                  .names = {last.begin(), last.begin() + static_cast<std::ptrdiff_t>(named_width)}};
        columns.width = named_width;
    }
    columns.names = std::move(header.names);
    columns.titles = std::move(header.titles);
    columns.header_line = header.line;
    for (const Row& row : words.first(words.size() - header.lines)) {
        columns.preamble.push_back({.line = row.line, .text = trimmed(row.text)});
    }
}

/// Drops lines of nothing but separators.
void drop_empty(std::vector<Row>& rows, char separator) {
    CellCutter cutter(separator);
    std::erase_if(rows, [&](const Row& row) {
        const char first = trimmed(row.text).front();
        return (first == separator || first == '"') && filled_width(cutter.cut(row.text)) == 0;
    });
}

/// Where the comment of a line begins, or npos.
std::size_t find_comment(std::string_view line) {
    static constexpr std::array<std::string_view, 12> errors = {
        "#n/a", "#na", "#div/0", "#value!", "#num!", "#ref!", "#name?", "#null!", "#nv", "#wert!", "#bezug!", "#n/d"};
    const std::size_t content = line.find_first_not_of(" \t\v\f");
    for (std::size_t from = 0;;) {
        const std::size_t at = line.find('#', from);
        if (at == std::string_view::npos) return at;
        if (at == content) return at;
        from = at + 1;
        const bool after_blank = line[at - 1] == ' ' || line[at - 1] == '\t';
        const std::string word = lower_case(line.substr(at, 8));
        const bool is_error =
            std::ranges::any_of(errors, [&](std::string_view each) { return word.starts_with(each); });
        const bool inside_quotes = std::ranges::count(line.substr(0, at), '"') % 2 == 1;
        if (after_blank && !is_error && !inside_quotes) return at;
    }
}

}  // namespace

Lines split_comments(std::string_view text, const std::string& source) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    refuse_binary(text, source);
    Lines lines;
    std::size_t number = 0;
    LineReader reader(text);
    while (const auto line = reader.next()) {
        ++number;
        refuse_long_line(line->size(), number, source);
        const std::size_t size = find_comment(*line);
        const std::string_view content = line->substr(0, size);
        if (!trimmed(content).empty()) {
            lines.rows.push_back({.line = number, .text = content});
        } else if (content.size() < line->size()) {
            lines.comments.push_back({.line = number, .text = trimmed(line->substr(content.size() + 1))});
        }
    }
    return lines;
}

Columns split_columns(std::string_view text, const std::string& source) {
    auto [comments, rows] = split_comments(text, source);
    const bool is_empty = comments.empty() && rows.empty();
    Columns columns;
    columns.source = source;
    columns.comments = std::move(comments);
    const TableForm form = find_table_form(rows);
    columns.separator = form.separator;
    columns.first = form.first;
    drop_empty(rows, columns.separator);
    auto [words, table, after] = find_table(std::move(rows), form);
    columns.rows = std::move(table);
    if (columns.rows.empty()) {
        CellCutter cutter(columns.separator);
        refuse_unknown_wavelengths(columns, words);
        if (words.size() > 1) refuse_word(columns, words[1].line, cutter.cut(words[1].text).front());
        throw InputError({.where = source,
                          .problem = is_empty ? "is empty" : "holds no numbers",
                          .why = "lines of a wavelength and its values are needed",
                          .remedy = "check that the file is complete"});
    }
    if (columns.rows.size() > 1 && is_header_of_numbers(columns.rows[0], columns.rows[1], columns.separator)) {
        words.push_back(columns.rows.front());
        columns.rows.erase(columns.rows.begin());
    }
    for (const Row& row : after) columns.epilogue.push_back({.line = row.line, .text = trimmed(row.text)});
    const Shape shape = shape_of(columns.rows, form);
    if (shape.word) refuse_word_among(columns, *shape.word, words);
    take_words(columns, words, shape);
    if (columns.names.empty()) take_header_from_comment(columns);
    name_sig_columns(columns);
    refuse_decimal_commas(columns, shape);
    refuse_other_widths(columns, shape);
    check_column_count(columns);
    return columns;
}

std::string label(const Columns& columns, std::size_t column) {
    if (!columns.names.empty() && !columns.names[column].empty()) return columns.names[column];
    return column == 0 ? "the wavelength" : fmt::format("column {}", column);
}

std::string at_line(const Columns& columns, std::size_t line) {
    return fmt::format("{}:{}", columns.source, line);
}

}  // namespace skinfit
