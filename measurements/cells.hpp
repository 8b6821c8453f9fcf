#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// What a line looks like once it is cut.
struct RowShape {
    std::size_t width;       ///< cells
    std::size_t filled;      ///< cells up to the last that holds text
    std::string_view first;  ///< the first cell
};

/// Cuts lines into cells: at each separator outside double quotes, or at runs of blanks where the separator is a blank.
/// The cells are trimmed and without quotes around them.
class CellCutter {
public:
    /// Cells are separated by `separator`.
    explicit CellCutter(char separator) : separator_(separator) {}
    /// The cells of `line`, at least one; valid until the next call.
    [[nodiscard]] std::span<const std::string_view> cut(std::string_view line);
    /// The same about them without cutting, which is several times as fast.
    [[nodiscard]] RowShape shape(std::string_view line);

private:
    char separator_;
    std::vector<std::string_view> cells_;
};

/// Where the first of `marks` outside double quotes is, or npos.
[[nodiscard]] std::size_t find_unquoted(std::string_view text, std::string_view marks);

/// The cells up to the last that holds text.
[[nodiscard]] std::size_t filled_width(std::span<const std::string_view> cells);

/// What a quoted cell means: doubled quotes stand for one, and an apostrophe before = + - @ marks it as text.
[[nodiscard]] std::string unescaped(std::string_view cell);

/// Throws InputError, naming the line, for text with bytes that no text has.
void refuse_binary(std::string_view text, const std::string& source);

}  // namespace skinfit
