#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "measurements/columns.hpp"
#include "measurements/table_plan.hpp"

namespace skinfit {

/// The columns that one spectrum is read from.
struct ColumnChoice {
    std::size_t wavelength;
    std::size_t value;
    std::optional<std::size_t> sigma;
    bool sole;  ///< the table has no other column of values
};

/// Finds the column called `wanted`, else the one with that number, as `TablePlan::number_of` counts; with nothing
/// wanted, the only column of values. Throws InputError when the choice is missing, unknown, ambiguous or no column of
/// values, and when the header is a row of wavelengths.
[[nodiscard]] ColumnChoice choose_column(const Columns& columns, const TablePlan& plan,
                                         const std::optional<std::string>& wanted);

/// Every column of values, with its uncertainty. Throws InputError as above.
[[nodiscard]] std::vector<ColumnChoice> all_columns(const Columns& columns, const TablePlan& plan);

}  // namespace skinfit
