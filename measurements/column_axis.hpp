#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measurements/described_table.hpp"
#include "measurements/spectrum_building.hpp"

namespace skinfit {

/// The wavelengths of a column, and the rows of the table that have one.
struct ColumnAxis {
    std::vector<bool> has_number{};  ///< for each row of the table
    std::vector<std::size_t> rows{};
    std::vector<double> numbers{};      ///< as in the file
    std::vector<double> all_numbers{};  ///< and those that are left out
    Grid grid{};
    std::string remark{};
};

/// Of the column `wavelength`. Numbers outside the range of wavelengths are left out where their unit is stated, as of
/// the thermal infrared, or where nine of ten lie in it. Throws InputError where nothing else is left, and for
/// a row without a number but where `may_lack_one` says so: in tables of several columns of wavelengths, and where a
/// row has no values either.
[[nodiscard]] ColumnAxis axis_of(const DescribedTable& table, std::size_t wavelength,
                                 const std::vector<bool>& may_lack_one);

}  // namespace skinfit
