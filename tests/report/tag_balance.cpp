#include "tests/report/tag_balance.hpp"

#include <algorithm>
#include <vector>

namespace skinfit::test {
namespace {

bool is_reference(std::string_view text) {
    const std::size_t end = text.find(';');
    return end != std::string_view::npos && end >= 2 && end <= 8 &&
           text.substr(1, end - 1).find_first_not_of("abcdefghijklmnopqrstuvwxyz#0123456789") == std::string_view::npos;
}

std::string text_complaint(std::string_view text) {
    if (text.find('>') != std::string_view::npos) return "a stray > in: " + std::string(text.substr(0, 80));
    for (std::size_t at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1)) {
        if (!is_reference(text.substr(at))) return "a stray & in: " + std::string(text.substr(at, 40));
    }
    return {};
}

}  // namespace

std::string tag_complaint(std::string_view markup) {
    constexpr std::string_view doctype = "<!DOCTYPE html>";
    if (markup.starts_with(doctype)) markup.remove_prefix(doctype.size());
    std::vector<std::string_view> open;
    while (!markup.empty()) {
        const std::size_t less = std::min(markup.find('<'), markup.size());
        const bool is_style = !open.empty() && open.back() == "style";  // holds `>` of selectors
        if (std::string wrong = text_complaint(markup.substr(0, less)); !wrong.empty() && !is_style) return wrong;
        markup.remove_prefix(less);
        if (markup.empty()) break;
        const std::size_t greater = markup.find('>');
        if (greater == std::string_view::npos) return "a tag without end";
        const std::string_view tag = markup.substr(1, greater - 1);
        markup.remove_prefix(greater + 1);
        const std::string_view name = tag.substr(0, tag.find(' '));
        if (tag.find('<') != std::string_view::npos) return "a < in the tag " + std::string(name);
        if (std::ranges::count(tag, '"') % 2 != 0) return "an odd number of quotes in the tag " + std::string(name);
        if (tag.ends_with('/')) continue;
        if (!tag.starts_with('/')) {
            open.push_back(name);
        } else if (open.empty() || open.back() != tag.substr(1)) {
            return "unexpected <" + std::string(tag) + ">";
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : "not closed: " + std::string(open.back());
}

}  // namespace skinfit::test
