#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measurements/described_table.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {

/// What states the unit of a column's values, but for the values of the other columns.
[[nodiscard]] UnitStatements unit_statements(const DescribedTable& table, std::size_t column,
                                             const ReadOptions& options);

/// The wavelengths, nm, of a table's rows in a column that need not be asked for; NaN where one holds none.
[[nodiscard]] std::vector<double> glance_at_wavelengths(const DescribedTable& table, std::size_t column);

/// The name of the first column whose values in the window show that the table is in percent, where no word states it;
/// empty where none does. Where some are called reflectance or transmittance, only they are asked. A number that is the
/// same in all rows, as a setting of the instrument, tells nothing.
[[nodiscard]] std::string column_in_percent(const DescribedTable& table, const ReadOptions& options);

}  // namespace skinfit
