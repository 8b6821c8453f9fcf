#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// `text` without white space at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Gives the lines of a text, one after the other; LF, CRLF and CR all end a line.
class LineReader {
public:
    /// `text` must outlive it.
    explicit LineReader(std::string_view text) : text_(text) {}
    /// The next line without its end; nothing after the last.
    [[nodiscard]] std::optional<std::string_view> next();

private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t feed_ = 0;  ///< the next LF at or after `at_`, or the end
};

/// Whether `c` is one of 0 to 9.
[[nodiscard]] constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// The lines of `text`; LF, CRLF and CR all end a line.
[[nodiscard]] std::vector<std::string_view> split_lines(std::string_view text);

/// The fields of `text` between the characters `separator`, trimmed; n separators give n + 1 fields.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// Lines and fields are views of the text: in `for (... : split_lines(read_file(path)))` it would be gone before them.
template <std::same_as<std::string> Text>
std::vector<std::string_view> split_lines(Text&& temporary) = delete;
template <std::same_as<std::string> Text>
std::vector<std::string_view> split(Text&& temporary, char separator) = delete;

/// The whole of `text` as a number in C notation with an optional leading plus, or nothing when it is not one.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The whole of `text` as a non-negative integer; `2e6` and `100000` are both good, `1.5` is not.
[[nodiscard]] std::optional<std::uint64_t> parse_count(std::string_view text);

/// The name of `names` with the least edit distance to `name`; `names` must not be empty.
[[nodiscard]] std::string_view nearest_name(std::string_view name, std::span<const std::string_view> names);

/// The same where at most a third of the characters of `name` have to be edited: a slip rather than another word.
[[nodiscard]] std::optional<std::string_view> similar_name(std::string_view name,
                                                           std::span<const std::string_view> names);

}  // namespace skinfit
