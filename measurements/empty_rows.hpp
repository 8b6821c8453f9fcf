#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "measurements/cell_numbers.hpp"
#include "measurements/described_table.hpp"

namespace skinfit {

/// The rows of a table that hold no readings.
struct EmptyRows {
    std::vector<bool> has_no_reading{};  ///< of each row: all its values are missing
    /// Of each row, by the column of its wavelengths: every spectrum, of two or more, is 0, which stands for bands that
    /// were not measured. Empty where there is no such row.
    std::map<std::size_t, std::vector<bool>> is_zero{};

    /// Makes the readings of a spectrum NaN where every one is 0; how many these are.
    [[nodiscard]] std::size_t take_out_zeros(std::size_t wavelength, std::span<double> values) const;
};

/// `numbers` are those that are wanted of the table.
[[nodiscard]] EmptyRows empty_rows(const DescribedTable& table, const NumberTable& numbers);

}  // namespace skinfit
