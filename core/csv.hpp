#pragma once

#include <string>
#include <string_view>

/// Tables of text that people open in spreadsheets.
namespace skinfit {

/// `text` with an apostrophe before it where a spreadsheet would calculate it: where it begins with = + - or @ and is
/// neither a number nor that character alone. Spreadsheets mark text in the same way.
[[nodiscard]] std::string marked_as_text(std::string_view text);

/// What `marked_as_text` was given.
[[nodiscard]] std::string_view without_text_mark(std::string_view cell);

/// `text` as one cell of a table: `printable`, marked as text, and in quotes where it needs them.
[[nodiscard]] std::string csv_cell(std::string_view text);

}  // namespace skinfit
