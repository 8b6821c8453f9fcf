#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Pieces of HTML pages: pure functions, the same bytes for the same input. What they make is well-formed XML too.
namespace skinfit {

/// A piece of a page, in which every tag that is opened is closed. Text becomes one by `escaped`, and in no other way.
struct Html {
    std::string markup;

    Html& operator+=(const Html& next) {
        markup += next.markup;
        return *this;
    }
};

[[nodiscard]] inline Html operator+(Html first, const Html& second) {
    return first += second;
}

/// `text` with bytes that are not UTF-8 replaced by U+FFFD.
[[nodiscard]] std::string valid_utf8(std::string_view text);

/// `text` as it is read: the characters that mean something in markup are replaced, so are bytes that are not UTF-8 and
/// control characters, by U+FFFD; tabs and line ends stay.
[[nodiscard]] Html escaped(std::string_view text);

/// Names and values of attributes; the values are escaped.
using HtmlAttributes = std::vector<std::pair<std::string_view, std::string>>;

/// An element with start and end tag.
[[nodiscard]] Html element(std::string_view name, const Html& content, const HtmlAttributes& attributes = {});

/// A paragraph of text, or of pieces.
[[nodiscard]] Html paragraph(std::string_view text);
[[nodiscard]] Html paragraph(const Html& content);

/// A heading below that of a section.
[[nodiscard]] Html subheading(std::string_view text);

/// A list with bullets; nothing for no items.
[[nodiscard]] Html bullet_list(const std::vector<Html>& items);

/// Terms and what is said of each, side by side where there is room.
[[nodiscard]] Html definition_list(const std::vector<std::pair<std::string, Html>>& items);

/// Pieces that open at a click on `summary`, and on paper.
[[nodiscard]] Html folded(std::string_view summary, const Html& content);

/// Text with its line ends and blanks, that opens at a click on `summary`; on paper it stays closed.
[[nodiscard]] Html folded_text(std::string_view summary, std::string_view text);

/// The word of a verdict or of a status, set off and coloured by what it means: `consistent` and `fitted` are good,
/// `suspect` is doubtful, `failed` and `rejected` are bad, every other word is neutral.
[[nodiscard]] Html badge(std::string_view word);

/// A patch of the colour `hex`, "#rrggbb", with `label` behind it. Asserts that `hex` is one.
[[nodiscard]] Html swatch(std::string_view hex, std::string_view label);

}  // namespace skinfit
