#include "measurements/words.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    const std::string text = lower_case(cell);
    return text.empty() || text == "nan" || text == "na" || text == "n/a";
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
