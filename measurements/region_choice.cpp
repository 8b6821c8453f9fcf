#include "measurements/region_choice.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {

Rectangle parse_rectangle(std::string_view text, const std::string& where) {
    const std::vector<std::string_view> cells = split(text, ',');
    std::array<std::size_t, 4> numbers{};
    bool good = cells.size() == numbers.size();
    for (std::size_t i = 0; good && i < numbers.size(); ++i) {
        const std::optional<std::uint64_t> number = parse_count(cells[i]);
        good = number && (i < 2 || *number > 0);
        if (good) numbers[i] = *number;
    }
    if (!good) {
        throw InputError({.where = where,
                          .problem = fmt::format("is {}", in_quotes(text)),
                          .why = "four whole numbers are needed, the last two above 0",
                          .remedy = "give x,y,width,height in pixels, counted from 0, such as 10,20,5,5"});
    }
    return {.first_sample = numbers[0], .first_line = numbers[1], .samples = numbers[2], .lines = numbers[3]};
}

}  // namespace skinfit
