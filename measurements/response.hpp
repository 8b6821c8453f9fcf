#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// How strongly an instrument answers to light of each wavelength, in any unit.
struct Response {
    std::vector<double> wavelength_nm;  ///< at least one, ascends strictly
    std::vector<double> value;          ///< not negative, one per wavelength

    /// Linear between the given points, zero outside them.
    [[nodiscard]] double operator()(double at_nm) const;
};

/// Reads a response from a text file of two columns, wavelength in nm and response; further columns are not read.
/// `split_columns` states which forms are understood. Throws InputError for a file that is missing or malformed, for
/// wavelengths that do not ascend and for a negative response.
[[nodiscard]] Response read_response(const std::filesystem::path& path);

/// The same for text already read; `source` names it in messages.
[[nodiscard]] Response parse_response(std::string_view text, const std::string& source);

}  // namespace skinfit
