#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// `text` in double quotes, on one line and cut after 40 bytes, for messages.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// True for text that stands for a number that is not there: nothing at all, NaN, NA, null and their kin, infinities, a
/// dash, an instrument's overflow, the errors of spreadsheets in any language (`#N/A`, `#WERT!`) and what old C
/// libraries of Microsoft print (`1.#QNAN`, `-1.#IND`), in any case.
[[nodiscard]] bool is_missing(std::string_view cell);

/// True for a number that programs write where there is none, and that no reading is: -999, -9999 and the like, the
/// extremes of integers, anything below -1e5, as the -1.23e34 of the USGS, and above 1e19, as NetCDF's 9.97e36.
[[nodiscard]] bool is_fill_number(double number);

/// Makes such numbers NaN, and those that the file declares to stand for missing values; gives the first of them.
std::optional<double> take_out_fill_numbers(std::span<double> values, std::span<const double> declared = {});

/// In lower case, with the signs that stand for letters, digits or blanks as these: `\u00b5` as u, `\u207b\u00b9` as
/// -1,
/// `\u03bb` as lambda, also in Latin-1.
[[nodiscard]] std::string plain_text(std::string_view text);

/// The words of a `plain_text`: its runs of letters and digits.
[[nodiscard]] std::vector<std::string> tokens_of(std::string_view plain);

/// Whether `part` occurs in `text`.
[[nodiscard]] inline bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

/// The text in lower case (ASCII letters).
[[nodiscard]] std::string lower_case(std::string_view text);

/// True for numbers and for what may be meant as one: a digit after at most two signs or marks, as in `4OO` or `-0,5`.
[[nodiscard]] bool starts_like_a_number(std::string_view text);

}  // namespace skinfit
