#include "measurements/empty_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measurements/words.hpp"

namespace skinfit {

std::size_t EmptyRows::take_out_zeros(std::size_t wavelength, std::span<double> values) const {
    const auto found = is_zero.find(wavelength);
    if (found == is_zero.end()) return 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
        if (found->second[row]) values[row] = std::numeric_limits<double>::quiet_NaN();
    }
    return static_cast<std::size_t>(std::ranges::count(found->second, true));
}

EmptyRows empty_rows(const DescribedTable& table, const NumberTable& numbers) {
    const std::size_t height = table.columns.rows.size();
    EmptyRows empty{.has_no_reading = std::vector<bool>(height, true)};
    bool has_zeros = false;
    for (std::size_t i = 0; i < numbers.cells.size(); ++i) {
        const double cell = numbers.cells[i];
        if (!std::isnan(cell) && !is_fill_number(cell)) empty.has_no_reading[i / numbers.width] = false;
        has_zeros = has_zeros || cell == 0;
    }
    if (!has_zeros || table.plan.values < 2) return empty;
    std::map<std::size_t, std::vector<std::size_t>> values;  // by their wavelengths
    for (std::size_t c = 0; c < table.plan.columns.size(); ++c) {
        const PlannedColumn& column = table.plan.columns[c];
        if (column.role == ColumnRole::value) values[column.wavelength].push_back(c);
    }
    for (const auto& [wavelength, columns] : values) {
        if (columns.size() < 2) continue;
        const NumberTable all = glance_at_numbers(table.columns, columns);
        std::vector<bool> zeros(height, true);
        for (std::size_t i = 0; i < all.cells.size(); ++i) {
            if (!all.holds_words[i % all.width] && all.cells[i] != 0) zeros[i / all.width] = false;
        }
        const auto count = static_cast<std::size_t>(std::ranges::count(zeros, true));
        if (count > 0 && count < height) empty.is_zero[wavelength] = std::move(zeros);
    }
    return empty;
}

}  // namespace skinfit
