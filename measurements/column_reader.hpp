#pragma once

#include <string>
#include <string_view>

#include "measurements/text_reader.hpp"

/// What messages about a table of columns need beside its spectra, which `read_columns` gives.
namespace skinfit {

/// Throws InputError that lists the columns of values where there are several.
void refuse_several_columns(std::string_view text, const std::string& source);

/// Where the reading of the chosen column at a wavelength stands that `read_columns` has read.
[[nodiscard]] ValuePlace place_in_columns(std::string_view text, const std::string& source, const ReadOptions& options,
                                          double wavelength_nm);

}  // namespace skinfit
