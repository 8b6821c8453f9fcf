#include "core/nearest_names.hpp"

#include <algorithm>
#include <optional>

#include "core/text.hpp"

namespace skinfit {
namespace {

std::vector<std::string_view> those_among(std::span<const std::string_view> names,
                                          std::span<const std::string_view> known) {
    std::vector<std::string_view> found;
    for (const std::string_view name : names) {
        if (std::ranges::find(known, name) != known.end()) found.push_back(name);
    }
    return found;
}

/// The first of `known` of which `name` is a part; none for a part that tells little.
std::optional<std::string_view> longer_name(std::string_view name, std::span<const std::string_view> known) {
    constexpr std::size_t telling = 3;  // characters
    if (name.size() < telling) return std::nullopt;
    const auto longer = std::ranges::find_if(
        known, [name](std::string_view each) { return each.find(name) != std::string_view::npos; });
    return longer == known.end() ? std::nullopt : std::optional(*longer);
}

}  // namespace

std::string spelt(std::string_view name) {
    std::string text(name);
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        if (c == ' ' || c == '-' || c == '\t') c = '_';
    }
    const std::size_t first = text.find_first_not_of('_');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of('_') - first + 1);
}

std::vector<std::string_view> meant_names(std::string_view name, std::span<const std::string_view> known) {
    const std::string word = spelt(name);
    if (std::vector<std::string_view> meant = those_among(everyday_names(word), known); !meant.empty()) return meant;
    if (const auto longer = longer_name(name, known)) return {*longer};
    if (const auto similar = similar_name(name, known)) return {*similar};
    for (const std::string_view part : split(word, '_')) {
        if (std::vector<std::string_view> meant = those_among(everyday_names(part), known); !meant.empty())
            return meant;
    }
    return {};
}

std::string either(std::span<const std::string_view> names, std::string_view before, std::string_view after) {
    std::string text;
    for (const std::string_view name : names) {
        if (!text.empty()) text += " or ";
        text.append(before).append(name).append(after);
    }
    return text;
}

}  // namespace skinfit
