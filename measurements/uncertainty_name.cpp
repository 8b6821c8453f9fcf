#include "measurements/uncertainty_name.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "measurements/words.hpp"

namespace skinfit {
namespace {

using Tokens = std::vector<std::string>;

struct UncertaintyWord {
    std::string_view first;
    std::string_view second;  ///< empty where one word does
    int rank;
};

constexpr std::array<UncertaintyWord, 24> uncertainty_words = {{{"standard", "uncertainty", 0},
                                                                {"standard", "deviation", 2},
                                                                {"standard", "error", 1},
                                                                {"std", "dev", 2},
                                                                {"std", "err", 1},
                                                                {"std", "error", 1},
                                                                {"st", "dev", 2},
                                                                {"sigma", "", 0},
                                                                {"uncertainty", "", 0},
                                                                {"unc", "", 0},
                                                                {"uncert", "", 0},
                                                                {"u", "", 0},
                                                                {"se", "", 1},
                                                                {"sem", "", 1},
                                                                {"stderr", "", 1},
                                                                {"ste", "", 1},
                                                                {"sd", "", 2},
                                                                {"std", "", 2},
                                                                {"stdev", "", 2},
                                                                {"stddev", "", 2},
                                                                {"stdv", "", 2},
                                                                {"error", "", 3},
                                                                {"err", "", 3},
                                                                {"errors", "", 3}}};

std::string joined(std::span<const std::string> tokens) {
    std::string text;
    for (const std::string& token : tokens) text += (text.empty() ? "" : " ") + token;
    return text;
}

/// Without a unit in brackets at the end, unless a letter stands before the bracket as in `u(R)`.
std::string without_unit_in_brackets(std::string name) {
    const std::size_t open = name.find_last_of("([");
    if (open == std::string::npos || open == 0) return name;
    const bool unit = name.find_first_of("%.1") > open && name.find_first_of("%.1") != std::string::npos;
    const bool is_unit = unit || contains(name.substr(open), "fraction") || contains(name.substr(open), "percent");
    return is_unit ? name.substr(0, open) : name;
}

bool is_not_standard(const Tokens& tokens, std::string_view name) {
    static constexpr std::array<std::string_view, 9> marks = {"expanded", "u95", "k2",       "variance", "cv",
                                                              "rsd",      "rel", "relative", "ci95"};
    const bool marked = std::ranges::any_of(
        tokens, [](const std::string& token) { return std::ranges::find(marks, token) != marks.end(); });
    // A capital U is the expanded uncertainty (JCGM 100:2008, 6.2).
    const bool capital = name == "U" || name.starts_with("U(") || name.starts_with("U_") || name.ends_with("_U");
    return marked || capital;
}

}  // namespace

std::string plain_base(std::string_view name) {
    const Tokens tokens = tokens_of(without_unit_in_brackets(plain_text(name)));
    return joined(tokens);
}

std::optional<UncertaintyName> uncertainty_named(std::string_view name) {
    const std::string plain = plain_text(name);
    if (plain == "+/-") return UncertaintyName{};
    Tokens tokens = tokens_of(without_unit_in_brackets(plain));
    for (const UncertaintyWord& word : uncertainty_words) {
        const std::size_t size = word.second.empty() ? 1 : 2;
        if (tokens.size() < size) continue;
        const auto is_at = [&](std::size_t at) {
            return tokens[at] == word.first && (size == 1 || tokens[at + 1] == word.second);
        };
        const std::size_t last = tokens.size() - size;
        if (!is_at(0) && !is_at(last)) continue;
        const auto at = static_cast<std::ptrdiff_t>(is_at(last) ? last : 0);
        const bool standard = !is_not_standard(tokens, name);
        tokens.erase(tokens.begin() + at, tokens.begin() + at + static_cast<std::ptrdiff_t>(size));
        std::erase(tokens, "of");
        if (!standard) tokens.clear();
        return UncertaintyName{.base = joined(tokens), .rank = word.rank, .is_standard = standard};
    }
    static constexpr std::array<std::string_view, 6> others = {"variance", "rsd",           "cv",
                                                               "u95",      "uncertainties", "expanded"};
    const bool is_other = !tokens.empty() && (std::ranges::find(others, tokens.back()) != others.end() ||
                                              std::ranges::find(others, tokens.front()) != others.end());
    if (!is_other) return std::nullopt;
    return UncertaintyName{.is_standard = false};
}

}  // namespace skinfit
