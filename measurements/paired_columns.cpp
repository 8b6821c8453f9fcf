#include "measurements/paired_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "measurements/cell_numbers.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// Whether all of a column's numbers may be wavelengths in nm.
bool holds_wavelengths(const Columns& columns, std::size_t c) {
    constexpr double lowest = 200;  // chosen: spectrometers measure from here
    constexpr double highest = 2500;
    constexpr std::size_t fewest = 3;
    std::vector<double> numbers = glance_at_numbers(columns, std::array{c}).cells;
    std::erase_if(numbers, [](double number) { return std::isnan(number); });
    return numbers.size() >= fewest &&
           std::ranges::all_of(numbers, [](double number) { return number >= lowest && number <= highest; }) &&
           (std::ranges::adjacent_find(numbers, std::greater_equal{}) == numbers.end() ||
            std::ranges::adjacent_find(numbers, std::less_equal{}) == numbers.end());
}

/// `x`, `X 2`, `x_3`.
bool is_called_x(const Columns& columns, std::size_t c) {
    if (columns.names.empty()) return false;
    const std::string name = lower_case(columns.names[c]);
    return name.starts_with('x') && name.find_first_not_of("0123456789_ .", 1) == std::string::npos;
}

}  // namespace

std::vector<std::size_t> every_other_column(const Columns& columns) {
    constexpr std::size_t fewest = 4;
    if (columns.width % 2 != 0 || columns.width < fewest) return {};
    bool are_called = true;
    bool are_wavelengths = true;
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < columns.width && (are_called || are_wavelengths); ++c) {
        const bool wanted = c % 2 == 0;
        if (wanted) found.push_back(c);
        are_called = are_called && is_called_x(columns, c) == wanted;
        are_wavelengths = are_wavelengths && holds_wavelengths(columns, c) == wanted;
    }
    return are_called || are_wavelengths ? found : std::vector<std::size_t>{};
}

}  // namespace skinfit
