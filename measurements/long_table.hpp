#pragma once

#include <string>
#include <vector>

#include "measurements/described_table.hpp"

namespace skinfit {

/// The rows of one specimen of a table.
struct TablePart {
    std::string name;  ///< what its rows have in common, as `arm`; empty where the table is not taken apart
    DescribedTable table;
};

/// Takes a long table apart, in which the cells of one or more columns tell spectra from each other that stand below
/// each other or interleaved, as in `site,wavelength,R`. Such a column is called after specimens or holds words; each
/// of its cells comes three times or more, with another wavelength each time; and the spectra go over the same
/// wavelengths, or, where it is called after specimens, over the same range. Any other table is its only part.
[[nodiscard]] std::vector<TablePart> parts_of(DescribedTable table);

}  // namespace skinfit
