#include "measurements/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "core/text.hpp"

namespace skinfit {

std::string in_quotes(std::string_view text) {
    constexpr std::size_t most = 40;
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; };  // of UTF-8
    std::size_t size = std::min(text.size(), most);
    while (size > 0 && size < text.size() && continues(text[size])) --size;
    std::string shown(text.substr(0, size));
    std::ranges::replace_if(
        shown, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    return fmt::format("\"{}{}\"", shown, size < text.size() ? "..." : "");
}

bool is_missing(std::string_view cell) {
    static constexpr std::array<std::string_view, 42> words = {
        "nan",  "na",   "n/a",  "null", "none",     "nil",    "missing", "n.a.",   "n.a",  "nd",  "n.d.",
        "n.d",  "<na>", "-",    "--",   "---",      ".",      "..",      "...",    "*",    "**",  "***",
        "****", "?",    "??",   "inf",  "infinity", "\u221e", "\u2013",  "\u2014", "over", "ovr", "overflow",
        "ovld", "nanq", "nans", "#n/a", "#na",      "#nv",    "#n/d",    "#div/0", "#nan"};
    if (cell.empty()) return true;
    if (is_digit(cell.back()) && cell.find('#') == std::string_view::npos) return false;  // the usual number, soon told
    std::string text = lower_case(cell);
    if (std::ranges::find(words, text) != words.end()) return true;
    const bool is_error = text.size() > 2 && text.front() == '#' && (text.back() == '!' || text.back() == '?');
    if (is_error) return true;  // of a spreadsheet, in any language: `#DIV/0!`, `#WERT!`, `#NAME?`
    if (text.front() == '+' || text.front() == '-') text.erase(0, 1);
    const bool is_nan = text.starts_with("nan(") && text.back() == ')';  // with its payload, as C99 prints it
    if (is_nan || std::ranges::find(words, text) != words.end()) return true;
    if (!text.starts_with("1.#") && !text.starts_with("1,#")) return false;
    const std::string_view kind = std::string_view(text).substr(3, text.find_last_not_of("0123456789") - 2);
    return kind == "qnan" || kind == "snan" || kind == "nan" || kind == "ind" || kind == "inf";
}

bool is_fill_number(double number) {
    static constexpr std::array<double, 22> numbers = {
        -99,   -777,   -888,   -999,   -7777,   -8888,   -9999,  -99999, 9999,   99999, 999999,
        -99.9, -99.99, -888.8, -999.9, -999.25, -9999.9, -32768, -32767, -32766, 65535, 2147483647.0};
    if (number > -90 && number < 9000) return false;
    constexpr double below_any_reading = -1e5;
    constexpr double beyond_any_reading = 1e19;
    return number <= below_any_reading || number >= beyond_any_reading ||
           std::ranges::find(numbers, number) != numbers.end();
}

std::optional<double> take_out_fill_numbers(std::span<double> values, std::span<const double> declared) {
    std::optional<double> first;
    for (double& value : values) {
        if (!is_fill_number(value) && std::ranges::find(declared, value) == declared.end()) continue;
        if (!first) first = value;
        value = std::numeric_limits<double>::quiet_NaN();
    }
    return first;
}

std::string plain_text(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 14> signs = {{{"\u00b5", "u"},
                                                                                             {"\u03bc", "u"},
                                                                                             {"\u207b\u00b9", "-1"},
                                                                                             {"\u207b\u00b2", "-2"},
                                                                                             {"\u2212", "-"},
                                                                                             {"\u00b2", "2"},
                                                                                             {"\u00d7", "x"},
                                                                                             {"\u00b7", "."},
                                                                                             {"\u03bb", "lambda"},
                                                                                             {"\u00c5", "angstrom"},
                                                                                             {"\u212b", "angstrom"},
                                                                                             {"\u03c3", "sigma"},
                                                                                             {"\u00b1", "+/-"},
                                                                                             {"\u00a0", " "}}};
    std::string plain = lower_case(text);
    if (std::ranges::all_of(plain, [](char c) { return static_cast<unsigned char>(c) < 0x80; })) return plain;
    for (const auto& [sign, meaning] : signs) {
        for (std::size_t at = plain.find(sign); at != std::string::npos; at = plain.find(sign, at)) {
            plain.replace(at, sign.size(), meaning);
        }
    }
    for (std::size_t i = 0; i < plain.size(); ++i) {  // Latin-1, where no character of UTF-8 ends in it
        const bool alone = i == 0 || static_cast<unsigned char>(plain[i - 1]) < 0x80;
        if (plain[i] == '\xb5' && alone) plain[i] = 'u';
        const bool ends = i + 1 == plain.size() || static_cast<unsigned char>(plain[i + 1]) < 0x80;
        if (plain[i] == '\xc5' && alone && ends) plain.replace(i, 1, "angstrom");
    }
    return plain;
}

std::vector<std::string> tokens_of(std::string_view plain) {
    std::vector<std::string> tokens;
    bool inside = false;
    for (const char c : plain) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_part = std::isalnum(byte) != 0 || byte >= 0x80;
        if (is_part && !inside) tokens.emplace_back();
        if (is_part) tokens.back() += c;
        inside = is_part;
    }
    return tokens;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

bool starts_like_a_number(std::string_view text) {
    if (parse_number(text)) return true;
    const std::size_t mantissa = text.find_first_not_of("+-.,");
    return mantissa != std::string_view::npos && mantissa <= 2 && is_digit(text[mantissa]);
}

}  // namespace skinfit
