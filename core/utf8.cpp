#include "core/utf8.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace skinfit {
namespace {

struct Character {
    std::uint32_t code;
    std::size_t length;  ///< bytes
};

/// The first character of `text`, which is not empty; nothing where its bytes are not UTF-8 [RFC 3629].
std::optional<Character> first_character(std::string_view text) {
    const auto byte = [text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return Character{.code = lead, .length = 1};
    const std::size_t length = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
    if (length == 0 || text.size() < length) return std::nullopt;
    std::uint32_t code = lead & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) return std::nullopt;
        code = code << 6U | (byte(i) & 0x3FU);
    }
    const std::uint32_t least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < least || code > 0x10FFFF || is_surrogate) return std::nullopt;
    return Character{.code = code, .length = length};
}

/// Controls, line and paragraph separators, and the marks without width that reorder or hide what stands beside them.
bool is_shown_by_number(std::uint32_t code) {
    const auto within = [code](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
    return code < 0x20 || within(0x7F, 0x9F) || within(0x200B, 0x200F) || within(0x2028, 0x202E) ||
           within(0x2060, 0x2069) || code == 0x61C || code == 0xFEFF || within(0xE0000, 0xE007F);
}

/// A character that is not shown, in the escapes of C.
std::string escape(std::uint32_t code) {
    switch (code) {
        case '\n':
            return "\\n";
        case '\r':
            return "\\r";
        case '\t':
            return "\\t";
        default:
            return code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
    }
}

}  // namespace

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::optional<Character> character = first_character(text);
        if (!character) return false;
        text.remove_prefix(character->length);
    }
    return true;
}

std::string printable(std::string_view text) {
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const std::optional<Character> character = first_character(text);
        if (!character) {
            shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
        } else if (is_shown_by_number(character->code)) {
            shown += escape(character->code);
        } else {
            shown += text.substr(0, character->length);
        }
        text.remove_prefix(character ? character->length : 1);
    }
    return shown;
}

}  // namespace skinfit
