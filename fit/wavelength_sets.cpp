#include "fit/wavelength_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <tuple>

#include "core/input_error.hpp"
#include "core/text.hpp"

namespace skinfit {

std::vector<double> parse_wavelengths(std::string_view text, const std::string& where) {
    const auto malformed = [&](const std::string& why) {
        return InputError({.where = where,
                           .problem = fmt::format("\"{}\" is no set of wavelengths", text),
                           .why = why,
                           .remedy = "give first:last:step as in 400:700:20, or a list as in 450,540,660, in nm"});
    };
    const auto too_many = [&](double count) {
        return InputError({.where = where,
                           .problem = fmt::format("{:.6g} wavelengths are too many", count),
                           .why = fmt::format("at most {} are computed at a time", most_wavelengths),
                           .remedy = "take a larger step, or parts of the range one after the other"});
    };
    const bool is_grid = text.find(':') != std::string_view::npos;
    std::vector<double> numbers;
    for (const std::string_view field : split(text, is_grid ? ':' : ',')) {
        const std::optional<double> number = parse_number(field);
        if (!number || !std::isfinite(*number)) throw malformed(fmt::format("\"{}\" is not a number", field));
        numbers.push_back(*number);
    }
    if (!is_grid) {
        if (std::ranges::adjacent_find(numbers, std::greater_equal<>{}) != numbers.end()) {
            throw malformed("a list must ascend");
        }
        if (numbers.size() > most_wavelengths) throw too_many(static_cast<double>(numbers.size()));
        return numbers;
    }
    if (numbers.size() != 3) throw malformed("three numbers are needed between the colons");
    const auto [first, last, step] = std::tuple(numbers[0], numbers[1], numbers[2]);
    if (!(step > 0) || last < first) throw malformed("the step must be positive and the last not below the first");
    const double steps = std::floor((last - first) / step * (1.0 + 1e-12));
    if (steps >= most_wavelengths) throw too_many(steps + 1.0);
    std::vector<double> grid;
    for (int i = 0; i <= static_cast<int>(steps); ++i) grid.push_back(first + i * step);
    return grid;
}

}  // namespace skinfit
