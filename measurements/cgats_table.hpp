#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// CGATS files before their numbers are read: tables of keywords, fields and sets.
namespace skinfit {

/// A word of a table, and where it stands.
struct CgatsToken {
    std::size_t line;
    std::string_view text;
};

/// A keyword's value: what stands behind it on its line, without quotes.
struct CgatsKeyword {
    std::size_t line;
    std::string value;
};

/// One table of the file: its keywords, the names of its fields and its sets, one after the other.
struct CgatsTable {
    std::map<std::string, CgatsKeyword, std::less<>> keywords;
    std::vector<CgatsToken> fields;
    std::vector<CgatsToken> cells;
    /// The first line of data that has another number of words than there are fields; none where all fit.
    std::optional<CgatsToken> uneven{};
    std::size_t words_of_uneven = 0;

    /// Its value; empty where there is none.
    [[nodiscard]] std::string_view keyword(std::string_view name) const;
    [[nodiscard]] std::optional<double> number(std::string_view name) const;
    /// The field of that name in any case, with or without underscores.
    [[nodiscard]] std::optional<std::size_t> field_called(std::string_view name) const;
};

/// The tables of `text`. Words are between blanks; where a line has tabs that make as many cells as there are fields,
/// between tabs, so that a name may hold blanks without quotes. Throws InputError for text that is binary or ends
/// inside data.
[[nodiscard]] std::vector<CgatsTable> cgats_tables(std::string_view text, const std::string& source);

/// Throws InputError at that line, or for the whole file where it is 0.
[[noreturn]] void refuse_cgats(const std::string& source, std::size_t line, const std::string& problem,
                               const std::string& why, const std::string& remedy = "check that the file is complete");

}  // namespace skinfit
