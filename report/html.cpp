#include "report/html.hpp"

#include <algorithm>
#include <cassert>

#include "core/json.hpp"

namespace skinfit {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
}

[[maybe_unused]] bool is_colour(std::string_view hex) {
    return hex.size() == 7 && hex.front() == '#' &&
           hex.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos;
}

std::string_view meaning_of(std::string_view word) {
    if (word == "consistent" || word == "fitted") return "good";
    if (word == "suspect") return "doubtful";
    if (word == "failed" || word == "rejected") return "bad";
    return "neutral";
}

}  // namespace

std::string valid_utf8(std::string_view text) {
    const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    return Json::parse(quoted).get<std::string>();
}

Html escaped(std::string_view text) {
    std::string markup;
    for (const char c : valid_utf8(text)) {
        switch (c) {
            case '&':
                markup += "&amp;";
                break;
            case '<':
                markup += "&lt;";
                break;
            case '>':
                markup += "&gt;";
                break;
            case '"':
                markup += "&quot;";
                break;
            case '\'':
                markup += "&#39;";
                break;
            default:
                is_control(c) ? markup += replacement : markup += c;
        }
    }
    return {markup};
}

Html element(std::string_view name, const Html& content, const HtmlAttributes& attributes) {
    std::string markup = "<" + std::string(name);
    for (const auto& [key, value] : attributes) {
        markup += " " + std::string(key) + "=\"" + escaped(value).markup + "\"";
    }
    return {markup + ">" + content.markup + "</" + std::string(name) + ">"};
}

Html paragraph(std::string_view text) {
    return paragraph(escaped(text));
}

Html paragraph(const Html& content) {
    return element("p", content) + Html{"\n"};
}

Html subheading(std::string_view text) {
    return element("h3", escaped(text)) + Html{"\n"};
}

Html bullet_list(const std::vector<Html>& items) {
    if (items.empty()) return {};
    Html content;
    for (const Html& item : items) content += element("li", item) + Html{"\n"};
    return element("ul", content) + Html{"\n"};
}

Html definition_list(const std::vector<std::pair<std::string, Html>>& items) {
    Html content;
    for (const auto& [term, meaning] : items) {
        content += element("dt", escaped(term)) + element("dd", meaning) + Html{"\n"};
    }
    return element("dl", content) + Html{"\n"};
}

Html folded(std::string_view summary, const Html& content) {
    return element("details", element("summary", escaped(summary)) + content) + Html{"\n"};
}

Html folded_text(std::string_view summary, std::string_view text) {
    const Html content = element("pre", element("code", escaped(text)), {{"tabindex", "0"}});
    return element("details", element("summary", escaped(summary)) + content, {{"class", "raw"}}) + Html{"\n"};
}

Html badge(std::string_view word) {
    return element("span", escaped(word), {{"class", "badge " + std::string(meaning_of(word))}});
}

Html swatch(std::string_view hex, std::string_view label) {
    assert(is_colour(hex));
    const Html patch = element("span", {}, {{"class", "patch"}, {"style", "background-color:" + std::string(hex)}});
    return element("span", patch + escaped(label), {{"class", "swatch"}});
}

}  // namespace skinfit
