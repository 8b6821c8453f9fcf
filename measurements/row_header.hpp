#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/abscissa.hpp"
#include "measurements/value_statement.hpp"

namespace skinfit {

/// The header of a table with a spectrum in each row: labels, wavelengths side by side, perhaps labels again.
struct RowHeader {
    std::size_t line = 0;  ///< counted from 1
    char separator = ',';
    std::size_t width = 0;               ///< cells
    std::vector<std::size_t> label{};    ///< which cells are labels; the first is 0
    std::vector<std::string> labels{};   ///< their names
    std::size_t first_value = 0;         ///< the first cell of values
    std::vector<double> numbers{};       ///< the abscissae as in the file, at least three
    std::optional<Abscissa> abscissa{};  ///< that a name states; else they are nm
    ValueStatement states{};             ///< by the prefix of the wavelengths, as in `R_400`

    /// The wavelengths, nm.
    [[nodiscard]] std::vector<double> wavelength_nm() const {
        return wavelengths_nm(abscissa.value_or(Abscissa{}), numbers);
    }
};

/// Finds it: the first of the first hundred lines with text that names labels and at least three wavelengths which
/// ascend or descend, as `360`, `360 nm`, `nm360`, `SPEC_360`, `X360`, `WL360` or `R_360nm`; or a comment of that form
/// above a first line of as many cells. Where its first name speaks of wavelengths, the numbers may be names of columns
/// instead: they are if the first column goes over a wider range of wavelengths than they do.
[[nodiscard]] std::optional<RowHeader> find_row_header(std::string_view text);

/// Throws InputError where the header and the first column of `text` may both be wavelengths.
void refuse_two_axes(std::string_view text, const std::string& source);

/// Of header cells, cut by `separator`; whatever stands below.
[[nodiscard]] std::optional<RowHeader> row_header_in(std::string_view line, std::size_t number);

}  // namespace skinfit
