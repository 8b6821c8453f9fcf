#include "measurements/declared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::string_view meaning_of(std::string_view key) {
    static constexpr std::array<std::string_view, 12> counts = {
        "npoints",    "numberofpoints",     "noofpoints",
        "nrofpoints", "numberofdatapoints", "datapoints",
        "points",     "numpoints",          "numberofpixelsinprocessedspectrum",
        "channels",   "numberofchannels",   "numberofbands"};
    struct Meaning {
        std::string_view key;
        std::string_view meaning;
    };
    static constexpr std::array<Meaning, 5> others = {{{"firstx", "first x"},
                                                       {"lastx", "last x"},
                                                       {"firsty", "first y"},
                                                       {"maxy", "largest y"},
                                                       {"miny", "smallest y"}}};
    const std::string plain = bare_key(key);
    if (std::ranges::find(counts, plain) != counts.end()) return "count";
    const auto found = std::ranges::find(others, std::string_view(plain), &Meaning::key);
    return found == others.end() ? std::string_view{} : found->meaning;
}

/// 0.01 for `12.34`; of numbers in powers of ten, the step of their mantissa.
double last_decimal(std::string_view number) {
    const std::size_t exponent = number.find_first_of("eE");
    const std::string_view mantissa = number.substr(0, exponent);
    const std::size_t point = mantissa.find('.');
    const auto decimals = point == std::string_view::npos ? 0.0 : static_cast<double>(mantissa.size() - point - 1);
    double power = 0;
    if (exponent != std::string_view::npos) power = parse_number(number.substr(exponent + 1)).value_or(0);
    return std::pow(10.0, power - decimals);
}

}  // namespace

std::string bare_key(std::string_view key) {
    std::string letters = lower_case(key);
    std::erase_if(letters, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
    return letters;
}

std::optional<Declared> declared_by(std::size_t line, std::string_view key, std::string_view value) {
    const std::string_view meaning = meaning_of(key);
    const std::string_view word = value.substr(0, value.find_first_of(" \t(,;"));
    const std::optional<double> number = parse_number(word);
    if (meaning.empty() || !number || !std::isfinite(*number)) return std::nullopt;
    return Declared{.line = line,
                    .key = std::string(key),
                    .meaning = std::string(meaning),
                    .number = *number,
                    .step = last_decimal(word)};
}

void check_declared(const std::string& source, std::span<const Declared> declared, std::span<const double> x,
                    std::span<const double> y) {
    for (const Declared& each : declared) {
        std::optional<double> found;
        if (each.meaning == "count") found = static_cast<double>(x.size());
        if (each.meaning == "first x") found = x.front();
        if (each.meaning == "last x") found = x.back();
        if (each.meaning == "first y" && !y.empty()) found = y.front();
        if (each.meaning == "largest y" && !y.empty()) found = std::ranges::max(y);
        if (each.meaning == "smallest y" && !y.empty()) found = std::ranges::min(y);
        if (!found || std::isnan(*found)) continue;
        const double tolerance = 0.6 * each.step + 1e-4 * std::abs(*found);  // of numbers that are rounded for people
        if (std::abs(*found - each.number) <= (each.meaning == "count" ? 0 : tolerance)) continue;
        throw InputError({.where = fmt::format("{}:{}", source, each.line),
                          .problem = fmt::format("{} is {}", each.key, each.number),
                          .why = each.meaning == "count"
                                     ? fmt::format("the table has {} readings", *found)
                                     : fmt::format("the {} of the table is {}", each.meaning, *found),
                          .remedy = "check that the file is complete and unchanged, or delete this line"});
    }
}

}  // namespace skinfit
