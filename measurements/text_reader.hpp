#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// The unit of the values in a file.
enum class Unit { fraction, percent };

/// What to take from a file, where the file leaves a choice.
struct ReadOptions {
    std::optional<std::string> column;  ///< a column's name, or its number counted from 1 without the wavelengths
    std::optional<Unit> unit;           ///< overrides the unit rule
};

/// Reads one spectrum from a text file of columns, the first of which is the wavelength in nm.
///
/// Columns are separated by commas, semicolons, tabs or spaces; lines end with LF, CRLF or CR; text after `#` is a
/// comment; one header line may name the columns. A file with several value columns needs `options.column`. Comments
/// of the form `# key: value` with the keys quantity, unit, incidence_deg, specular and specimen describe the
/// measurement, as in `measurements/data/`. A column called `sigma`, or `<column>_sigma`, is the standard uncertainty
/// of the values. A column whose name contains "transmittance" or "reflectance" states its quantity.
///
/// Unit rule: as stated by `options.unit`, by the `unit` comment, or by a `%` or "percent" in the header; else percent
/// when the largest value exceeds 1.5, and fraction otherwise.
///
/// Wavelengths are sorted. Throws InputError for a file that is missing, empty, binary, holds a word among numbers or
/// a value that is not finite, repeats a wavelength, has several columns and none chosen, or values below 0 or above
/// 1.5 once they are fractions.
[[nodiscard]] Spectrum read_spectrum(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for text already read; `source` names it in messages.
[[nodiscard]] Spectrum parse_spectrum(std::string_view text, const std::string& source,
                                      const ReadOptions& options = {});

}  // namespace skinfit
