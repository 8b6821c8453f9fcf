#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/abscissa.hpp"

namespace skinfit {

/// Wavelengths side by side, for one value of each row at each.
struct RowBlock {
    std::size_t first_value = 0;    ///< the first cell of values
    std::vector<double> numbers{};  ///< the abscissae as in the file, at least three
    std::string about{};  ///< what their names, or the line above them, say about the values: `R`, `SCI`, `sd`
};

/// The header of a table with a spectrum, or several, in each row: labels and blocks of wavelengths.
struct RowHeader {
    std::size_t line = 0;  ///< counted from 1
    char separator = ',';
    std::size_t width = 0;               ///< cells
    std::vector<std::size_t> label{};    ///< which cells are labels; the first is 0
    std::vector<std::string> labels{};   ///< their names
    std::vector<RowBlock> blocks{};      ///< at least one
    std::optional<Abscissa> abscissa{};  ///< that a name states; else they are nm

    /// The wavelengths, nm, of a block.
    [[nodiscard]] std::vector<double> wavelength_nm(const RowBlock& block) const {
        return wavelengths_nm(abscissa.value_or(Abscissa{}), block.numbers);
    }
    /// Those of the first.
    [[nodiscard]] std::vector<double> wavelength_nm() const { return wavelength_nm(blocks.front()); }
};

/// Finds it: the first of the first hundred lines with text that names labels and at least three wavelengths which
/// ascend or descend, as `wavelength_named` reads them; or a comment of that form above a first line of as many cells.
/// Other names, or the first wavelength again, begin another block. A header one shorter than the rows, as of R's
/// write.table, gets a label without a name in front. Where its first name speaks of wavelengths, or is empty, the
/// numbers may be names of columns instead: they are if the first column goes over a wider range of wavelengths than
/// they do.
[[nodiscard]] std::optional<RowHeader> find_row_header(std::string_view text);

/// Throws InputError where the header and the first column of `text` may both be wavelengths.
void refuse_two_axes(std::string_view text, const std::string& source);

/// Of one line; whatever stands below, but for the number of cells where `row_width` gives it.
[[nodiscard]] std::optional<RowHeader> row_header_in(std::string_view line, std::size_t number,
                                                     std::size_t row_width = 0);

}  // namespace skinfit
