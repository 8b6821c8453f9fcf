#include "measurements/stated_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

bool is_scale_key(std::string_view key, std::span<const std::string_view> keys) {
    return std::ranges::find(keys, key) != keys.end();
}

/// What a key does to values; all false for other keys.
struct ScaleKey {
    bool multiplies = false;
    bool divides = false;
    bool scales = false;  ///< one or the other, or has done so
    bool shifts = false;
    bool may_have = false;  ///< scaled or shifted them before they were written
};

ScaleKey scale_key(std::string_view written, bool is_comment) {
    static constexpr std::array<std::string_view, 5> multipliers = {"yfactor", "multiplier", "multiplyby",
                                                                    "multiplication", "multiplicationfactor"};
    static constexpr std::array<std::string_view, 4> divisors = {"divisor", "divideby", "dividedby", "denominator"};
    static constexpr std::array<std::string_view, 12> ambiguous = {
        "scale",     "scalefactor",     "scalingfactor", "reflectancescalefactor", "factor", "scaling",
        "datascale", "datascalefactor", "xfactor",       "datagainvalues",         "yscale", "yscalefactor"};
    static constexpr std::array<std::string_view, 2> gains = {"gain", "datagain"};
    static constexpr std::array<std::string_view, 5> offsets = {"offset", "addoffset", "yoffset", "dataoffset",
                                                                "dataoffsetvalues"};
    const std::string key = bare_key(written);
    ScaleKey found{.multiplies = is_scale_key(key, multipliers),
                   .divides = is_scale_key(key, divisors),
                   .scales = is_scale_key(key, ambiguous) || (is_comment && is_scale_key(key, gains)),
                   .shifts = is_scale_key(key, offsets) && (is_comment || key != "offset")};
    const bool certain = found.multiplies || found.divides || found.scales || found.shifts;
    found.may_have = !certain && (key.ends_with("factor") || key == "slope" || key == "intercept");
    return found;
}

void remark_on(FileStatements& statements, std::size_t line, std::string_view words, std::string_view number) {
    statements.remarks.push_back(fmt::format("{}states {} {}; the values are read as they stand",
                                             line > 0 ? fmt::format("line {} ", line) : "the file ", in_quotes(words),
                                             number));
}

}  // namespace

void take_scale(FileStatements& statements, const std::string& source, std::size_t line, const KeyedLine& keyed,
                bool is_comment) {
    const ScaleKey key = scale_key(keyed.key, is_comment);
    if (!starts_like_a_number(keyed.value)) return;
    if (key.may_have) {
        const std::string_view word = keyed.value.substr(0, keyed.value.find_first_of(" ,;"));
        const std::optional<double> number = parse_number(word);
        if (number && *number != (bare_key(keyed.key) == "intercept" ? 0 : 1)) {
            remark_on(statements, line, keyed.key, word);
        }
        return;
    }
    if (!key.multiplies && !key.divides && !key.scales && !key.shifts) return;
    const std::optional<double> number = parse_number(keyed.value);
    if (number && *number == (key.shifts ? 0 : 1)) return;
    if ((key.multiplies || key.divides) && number && *number > 0 && std::isfinite(*number)) {
        statements.factor *= key.multiplies ? *number : 1 / *number;
        statements.remarks.push_back(fmt::format("the values are {} by {}, as {} states",
                                                 key.multiplies ? "multiplied" : "divided", *number,
                                                 in_quotes(keyed.key)));
        return;
    }
    throw InputError({.where = line > 0 ? fmt::format("{}:{}", source, line) : source,
                      .problem = fmt::format("states {} of {}", in_quotes(keyed.key), in_quotes(keyed.value)),
                      .why = key.shifts
                                 ? "offsets of text files are not applied, and the values would be wrong without it"
                                 : "whether values are to be multiplied or divided by it, or have been, is not said",
                      .remedy = "apply it to the values and delete this line, or call it multiplier or divisor"});
}

void take_scale_in_prose(FileStatements& statements, const std::string& source, std::size_t line,
                         std::string_view prose, bool is_comment) {
    if (const std::size_t blank = prose.rfind(' '); blank != std::string_view::npos) {
        const KeyedLine keyed{.key = trimmed(prose.substr(0, blank)), .value = prose.substr(blank + 1)};
        const ScaleKey key = scale_key(keyed.key, is_comment);
        if (parse_number(keyed.value) && (key.multiplies || key.divides || key.scales || key.shifts)) {
            take_scale(statements, source, line, keyed, is_comment);
            return;
        }
    }
    const std::string plain = plain_text(prose);
    for (const std::string_view words : {"scaled by ", "multiplied by ", "divided by "}) {
        const std::size_t at = plain.find(words);
        if (at == std::string::npos) continue;
        const std::string_view rest = std::string_view(plain).substr(at + words.size());
        const std::string_view word = rest.substr(0, rest.find_first_of(" ,;"));
        const std::optional<double> number = parse_number(word);
        if (number && *number != 1 && *number != 100) remark_on(statements, line, trimmed(words), word);
    }
}

}  // namespace skinfit
