#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <vector>

#include "core/text.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

using SpecularWords = std::span<const std::string_view>;

bool is_among(std::string_view word, SpecularWords words) {
    return std::ranges::find(words, word) != words.end();
}

/// The words of a text as they are written.
std::vector<std::string_view> written_words(std::string_view text) {
    std::vector<std::string_view> words;
    const auto is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && is_part(text[end])) ++end;
        if (end > i) words.push_back(text.substr(i, end - i));
        i = std::max(end, i + 1);
    }
    return words;
}

/// `forearmSCE`: the short form in capitals behind small letters.
bool ends_a_name(std::string_view word, std::string_view form) {
    return word.size() > form.size() && word.ends_with(form) &&
           std::islower(static_cast<unsigned char>(word[word.size() - form.size() - 1])) != 0;
}

/// Without degrees, and without blanks at strokes and colons: `45 / 0 deg` is `45/0`.
std::string packed_geometry(std::string_view plain) {
    std::string packed;
    const auto joins = [](char c) { return c == '/' || c == ':'; };
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const std::string_view rest = plain.substr(i);
        if (rest.starts_with("\u00b0") || rest.starts_with("deg")) {
            i += rest.front() == 'd' ? 2 : 1;
            continue;
        }
        if (joins(plain[i])) {
            while (!packed.empty() && packed.back() == ' ') packed.pop_back();
        }
        if (plain[i] != ' ' || packed.empty() || !joins(packed.back())) packed += plain[i];
    }
    while (!packed.empty() && packed.back() == ' ') packed.pop_back();
    return packed;
}

/// Whether one of the forms stands there, and not as a part of a word, a date or another number.
bool holds_form(const std::string& packed, SpecularWords forms) {
    const auto goes_on = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || contains("/.:-", {&c, 1});
    };
    for (const std::string_view form : forms) {
        for (std::size_t at = packed.find(form); at != std::string::npos; at = packed.find(form, at + 1)) {
            const std::size_t end = at + form.size();
            if ((at == 0 || !goes_on(packed[at - 1])) && (end == packed.size() || !goes_on(packed[end]))) return true;
        }
    }
    return false;
}

bool any_begins(const std::vector<std::string>& tokens, std::string_view beginning) {
    return std::ranges::any_of(tokens, [&](const std::string& token) { return token.starts_with(beginning); });
}

}  // namespace

std::optional<Specular> specular_stated(std::string_view text) {
    static constexpr std::array<std::string_view, 5> in = {"SCI", "SPIN", "SIN", "RSIN", "sci"};
    static constexpr std::array<std::string_view, 5> out = {"SCE", "SPEX", "SEX", "RSEX", "sce"};
    // CIE 15: a sphere with and without the specular part; of 45/0 and 0/45 no instrument collects it.
    static constexpr std::array<std::string_view, 4> sphere_in = {"di:8", "di/8", "8:di", "8/di"};
    static constexpr std::array<std::string_view, 4> sphere_out = {"de:8", "de/8", "8:de", "8/de"};
    static constexpr std::array<std::string_view, 2> angles = {"45/0", "0/45"};
    bool included = false;
    bool excluded = false;
    for (const std::string_view word : written_words(text)) {
        included = included || is_among(word, in) || ends_a_name(word, "SCI");
        excluded = excluded || is_among(word, out) || ends_a_name(word, "SCE");
    }
    const std::string plain = plain_text(text);
    const std::vector<std::string> tokens = tokens_of(plain);
    const std::string packed = packed_geometry(plain);
    const bool speaks_of_it = contains(plain, "specular") || contains(plain, "gloss") ||
                              std::ranges::find(tokens, std::string_view("spec")) != tokens.end();
    included =
        included || plain == "sci" || holds_form(packed, sphere_in) || (speaks_of_it && any_begins(tokens, "incl"));
    excluded = excluded || plain == "sce" || holds_form(packed, sphere_out) ||
               (speaks_of_it && any_begins(tokens, "excl")) || holds_form(packed, angles) || packed == "45:0" ||
               packed == "0:45";
    if (included == excluded) return std::nullopt;
    return included ? Specular::included : Specular::excluded;
}

std::optional<Specular> specular_stated(std::string_view name, std::string_view value) {
    static constexpr std::array<std::string_view, 5> yes = {"yes", "y", "on", "true", "1"};
    static constexpr std::array<std::string_view, 5> no = {"no", "n", "off", "false", "0"};
    static constexpr std::array<std::string_view, 5> in = {"included", "include", "incl", "in", "i"};
    static constexpr std::array<std::string_view, 6> out = {"excluded", "exclude", "excl", "ex", "out", "e"};
    if (const auto stated = specular_stated(value)) return stated;
    const std::string answer = plain_text(value);
    const std::string_view word = trimmed(std::string_view(answer).substr(0, answer.find('.')));
    const bool asks = contains(plain_text(name), "specular");
    if (asks && is_among(word, in)) return Specular::included;
    if (asks && is_among(word, out)) return Specular::excluded;
    const bool is_word_too = name == "SEX" || name == "SIN";  // a label of persons
    const auto asked = is_word_too ? std::nullopt : specular_stated(name);
    if (!asked || (!is_among(word, yes) && !is_among(word, no))) return std::nullopt;
    const bool included = (*asked == Specular::included) == is_among(word, yes);
    return included ? Specular::included : Specular::excluded;
}

}  // namespace skinfit
