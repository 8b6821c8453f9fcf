#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measurements/columns.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/row_header.hpp"
#include "measurements/row_uncertainties.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/uncertainty_name.hpp"

namespace skinfit {

/// A block of the header, and what it states.
struct ValueBlock {
    RowBlock cells;
    std::vector<std::size_t> used{};  ///< which of its numbers are in the range of wavelengths
    Grid grid{};
    ValueStatement states{};
    std::optional<Specular> specular{};
    std::optional<UncertaintyName> uncertainty{};
    std::size_t owner = 0;  ///< of uncertainties: the block of their values
};

/// Those of `header`, in its order, the first of values; `source` names the file. What is left out or converted is
/// added to the remarks of `statements`. Throws InputError for abscissae that are no wavelengths.
[[nodiscard]] std::vector<ValueBlock> value_blocks(RowHeader header, const std::string& source,
                                                   FileStatements& statements);

/// Whether any of the values has a comma, which is then the decimal mark of all.
[[nodiscard]] bool has_decimal_commas(const RowHeader& header, std::span<const Row> rows);

/// Bands that are 0 in every spectrum, of two or more, were not measured: their readings become NaN, with a remark.
void take_out_zero_bands(std::vector<ReadRow>& rows, const std::vector<ValueBlock>& blocks);

}  // namespace skinfit
