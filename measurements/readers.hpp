#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"
#include "measurements/text_reader.hpp"

/// One reader per form of text. Each says whether it recognises a text and takes all spectra out of one that has its
/// form: those with at least one value, missing values left out and counted. `source` names the text in messages; of
/// `options`, only `columns` heeds the choice of a column. All throw InputError for text that is not of their form.
namespace skinfit {

/// Wavelengths in the first column, one spectrum in each other one.
[[nodiscard]] std::vector<Spectrum> read_columns(std::string_view text, const std::string& source,
                                                 const ReadOptions& options);

}  // namespace skinfit
