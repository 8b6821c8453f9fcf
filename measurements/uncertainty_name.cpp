#include "measurements/uncertainty_name.hpp"

#include <algorithm>
#include <array>
#include <iterator>
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

constexpr std::array<UncertaintyWord, 36> uncertainty_words = {{{"standard", "uncertainty", 0},
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
                                                                {"errors", "", 3},
                                                                {"standardabweichung", "", 2},
                                                                {"stdabw", "", 2},
                                                                {"standardfehler", "", 1},
                                                                {"standardunsicherheit", "", 0},
                                                                {"unsicherheit", "", 0},
                                                                {"ecart", "type", 2},
                                                                {"\u00e9cart", "type", 2},
                                                                {"incertitude", "", 0},
                                                                {"delta", "r", 3},
                                                                {"delta", "reflectance", 3},
                                                                {"desviacion", "estandar", 2},
                                                                {"deviazione", "standard", 2}}};

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

/// A factor of coverage other than 1: `k=2`, `2 sigma` and `2*SD` in front, `2sigma`; but of `2_sigma` the 2 may be the
/// name of what is measured.
bool is_covered(const Tokens& tokens, std::string_view name) {
    static constexpr std::array<std::string_view, 6> words = {"sigma", "sd", "std", "se", "sem", "u"};
    const auto is_factor = [](std::string_view text) {
        return !text.empty() && text != "1" && text.find_first_not_of("0123456789") == std::string_view::npos;
    };
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::string_view token = tokens[i];
        const std::string_view next = i + 1 < tokens.size() ? std::string_view(tokens[i + 1]) : std::string_view{};
        const std::size_t letters = std::min(token.find_first_not_of("0123456789"), token.size());
        const bool is_word = std::ranges::find(words, token.substr(letters)) != words.end();
        if (token == "k" && is_factor(next)) return true;
        if (letters > 0 && is_factor(token.substr(0, letters)) && is_word) return true;
        const bool apart = name.size() > token.size() && (name[token.size()] == ' ' || name[token.size()] == '*');
        if (i == 0 && apart && is_factor(token) && std::ranges::find(words, next) != words.end() &&
            name.find('%') == std::string_view::npos) {
            return true;
        }
    }
    return false;
}

/// `tokens` are all of the name.
bool is_not_standard(const Tokens& tokens, std::string_view name) {
    static constexpr std::array<std::string_view, 22> marks = {
        "expanded", "model", "u95",        "k2",       "k3",       "variance",  "var", "cv",
        "rsd",      "rel",   "relative",   "ci",       "ci95",     "lcl",       "ucl", "iqr",
        "95ci",     "ci99",  "confidence", "quartile", "quantile", "percentile"};
    const bool marked = std::ranges::any_of(
        tokens, [](const std::string& token) { return std::ranges::find(marks, token) != marks.end(); });
    // A capital U is the expanded uncertainty (JCGM 100:2008, 6.2).
    const bool capital = name == "U" || name.starts_with("U(") || name.starts_with("U (") || name.starts_with("U_") ||
                         name.starts_with("U [") || name.ends_with("_U");
    const bool is_interval = contains(name, "95%") || contains(name, "95 %") || contains(name, "99%");
    return marked || capital || is_interval || is_covered(tokens, name);
}

/// Without what says that values are means, where anything else is left.
Tokens without_mean(Tokens tokens) {
    static constexpr std::array<std::string_view, 4> words = {"mean", "average", "avg", "mittelwert"};
    Tokens others;
    std::ranges::copy_if(tokens, std::back_inserter(others),
                         [](const std::string& token) { return std::ranges::find(words, token) == words.end(); });
    return others.empty() ? tokens : others;
}

}  // namespace

std::string plain_base(std::string_view name) {
    const Tokens tokens = tokens_of(without_unit_in_brackets(plain_text(name)));
    return joined(without_mean(tokens));
}

std::optional<UncertaintyName> uncertainty_named(std::string_view name) {
    const std::string plain = plain_text(name);
    Tokens tokens = tokens_of(without_unit_in_brackets(plain));
    const bool standard = !is_not_standard(tokens_of(plain), name);
    if (plain.starts_with("+/-") || plain.ends_with("+/-")) {
        return UncertaintyName{.base = standard ? joined(without_mean(tokens)) : "", .is_standard = standard};
    }
    if (tokens.size() > 1 && tokens.front() == "1") tokens.erase(tokens.begin());  // `1 sigma`
    for (const UncertaintyWord& word : uncertainty_words) {
        const std::size_t size = word.second.empty() ? 1 : 2;
        if (tokens.size() < size) continue;
        const auto is_at = [&](std::size_t at) {
            return tokens[at] == word.first && (size == 1 || tokens[at + 1] == word.second);
        };
        const std::size_t last = tokens.size() - size;
        if (!is_at(0) && !is_at(last)) continue;
        const auto at = static_cast<std::ptrdiff_t>(is_at(last) ? last : 0);
        tokens.erase(tokens.begin() + at, tokens.begin() + at + static_cast<std::ptrdiff_t>(size));
        std::erase(tokens, "of");
        if (!standard) tokens.clear();
        return UncertaintyName{.base = joined(without_mean(tokens)), .rank = word.rank, .is_standard = standard};
    }
    // Words that may be parts of other names elsewhere.
    static constexpr std::array<std::string_view, 15> others = {"variance",      "var",      "rsd", "cv",   "u95",
                                                                "uncertainties", "expanded", "ci",  "ci95", "95ci",
                                                                "ci99",          "lcl",      "ucl", "iqr",  "2sigma"};
    const auto is_other = [](const std::string& token) { return std::ranges::find(others, token) != others.end(); };
    const bool is_interval = contains(plain, "confidence") || contains(plain, "95%") || contains(plain, "95 %");
    if (tokens.empty() || (!is_interval && !is_other(tokens.front()) && !is_other(tokens.back()))) return std::nullopt;
    return UncertaintyName{.is_standard = false};
}

std::optional<UncertaintyName> uncertainty_glued_to(std::string_view base, std::string_view name) {
    static constexpr std::array<std::string_view, 6> words = {"sigma", "stderr", "stdev", "std", "sd", "se"};
    static constexpr std::array<std::string_view, 2> letters = {"u", "d"};
    const std::string plain = plain_base(name);
    if (base.empty() || plain.size() <= base.size() || !plain.ends_with(base)) return std::nullopt;
    const std::string_view before = std::string_view(plain).substr(0, plain.size() - base.size());
    const bool is_quantity = base == "r" || base == "t" || base == "reflectance" || base == "transmittance";
    const bool by_letter = is_quantity && std::ranges::find(letters, before) != letters.end();
    if (!by_letter && std::ranges::find(words, before) == words.end()) return std::nullopt;
    if (by_letter && name.starts_with('U')) return UncertaintyName{.is_standard = false};
    const int rank = before.starts_with("sigma") || before == "u" ? 0 : before == "se" || before == "stderr" ? 1 : 2;
    return UncertaintyName{.base = std::string(base), .rank = rank};
}

}  // namespace skinfit
