#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "measurements/columns.hpp"

namespace skinfit {

/// The columns to read, beside the wavelengths in column 0.
struct ColumnChoice {
    std::size_t value;
    std::optional<std::size_t> sigma;  ///< `<column>_sigma` where there is one, else `sigma`
    bool sole;                         ///< the table has no other column of values
};

/// Finds the column called `wanted`, else the one with that number, counted from 1 without the wavelengths; with
/// nothing wanted, the only column of values. A column called `sigma`, or `<column>_sigma` beside a `<column>`, holds
/// uncertainties, not values. Throws InputError when the choice is missing, unknown or ambiguous, and when the header
/// is a row of wavelengths.
[[nodiscard]] ColumnChoice choose_column(const Columns& columns, const std::optional<std::string>& wanted);

/// Every column of values, with its uncertainty. Throws InputError as above.
[[nodiscard]] std::vector<ColumnChoice> all_columns(const Columns& columns);

/// The column's name, or `the wavelength` or `column <number>` where it has none; for messages.
[[nodiscard]] std::string label(const Columns& columns, std::size_t column);

}  // namespace skinfit
