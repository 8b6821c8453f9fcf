#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// Prose that has a line to itself.
struct Comment {
    std::size_t line;       ///< counted from 1
    std::string_view text;  ///< trimmed, without the `#`
};

/// One line of a table, not taken apart; `CellCutter` does that.
struct Row {
    std::size_t line;       ///< counted from 1
    std::string_view text;  ///< without a comment at its end
};

/// A line about the names of columns that gives each of them something: a subject, a site, a quantity, a unit.
struct TitleLine {
    std::size_t line;                ///< counted from 1
    std::vector<std::string> cells;  ///< one per column, some perhaps empty
    bool is_statement;               ///< of values: quantity, unit or specular state, as in `Mode,SCI,SCE`
};

/// Text taken apart into lines of cells; which of them are numbers is not decided here. Views point into the text.
struct Columns {
    std::string source;  ///< names the text in messages
    std::vector<Comment> comments;
    std::vector<Comment> preamble;    ///< the lines of words above the header
    std::vector<Comment> epilogue;    ///< the lines below the table, as `find_table` tells them
    char separator = ' ';             ///< `\t`, `;`, `,`, or a blank for any run of blanks
    std::size_t width = 0;            ///< columns, at least 2; `plan_table` says what each holds
    std::size_t header_line = 0;      ///< counted from 1; 0 without a header
    std::vector<std::string> names;   ///< one per column, some perhaps empty; none without a header
    std::vector<TitleLine> titles{};  ///< above or below the names, from the top
    std::size_t first = 0;            ///< the column by whose numbers readings are known: behind names of specimens
    std::vector<Row> rows;            ///< at least 1, each of at least `width` cells
};

/// The lines of a text.
struct Lines {
    std::vector<Comment> comments;
    std::vector<Row> rows;  ///< all others that hold anything
};

/// Tells comments from other lines: a `#` begins one where it begins the line or a blank is before it, but not as a
/// part of `#N/A` and its kin. Throws InputError for binary text.
[[nodiscard]] Lines split_comments(std::string_view text, const std::string& source);

/// Takes `text` apart.
///
/// Separator: that of `find_table_form`. Separators and `#` inside double quotes are text. The table is what
/// `find_table` finds.
///
/// Header: the last line above the numbers, if it starts with a word and names every column; `find_header` states the
/// dialects. Without one, the last comment above the numbers where it has as many cells, as numpy.savetxt writes it.
/// Lines of words above it are the preamble. A line that starts like a number, as `4OO` does, is data, so
/// that a slip in the first row is found rather than taken for a name. A header one shorter than the rows, which begin
/// with names or numbers of their own, is that of R's write.table: it gets an empty name in front. Lines without any
/// text between separators count as empty, and cells that are empty in every line of the table's right end are dropped.
///
/// Throws InputError for text that is empty, binary or without data, for a word where a row should start, for rows that
/// differ in length, and for lines split at commas that look like decimal commas.
[[nodiscard]] Columns split_columns(std::string_view text, const std::string& source);

/// A column's name, or `the wavelength` of the first and `column <number>` of another without a name; for messages.
[[nodiscard]] std::string label(const Columns& columns, std::size_t column);

/// `source:line`, the way messages name a line.
[[nodiscard]] std::string at_line(const Columns& columns, std::size_t line);

}  // namespace skinfit
