#pragma once

#include <string>
#include <string_view>

namespace skinfit {

/// `text` in double quotes, on one line and cut after 40 bytes, for messages.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// True for text that stands for a number that is not there: nothing at all, NaN, NA or N/A in any case.
[[nodiscard]] bool is_missing(std::string_view cell);

/// The text in lower case (ASCII letters).
[[nodiscard]] std::string lower_case(std::string_view text);

/// True for numbers and for what may be meant as one: a digit after at most two signs or marks, as in `4OO` or `-0,5`.
[[nodiscard]] bool starts_like_a_number(std::string_view text);

}  // namespace skinfit
