#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/number_type.hpp"

namespace skinfit {

/// The order of the numbers in a cube's data: band after band, line after line with all bands of a line together, or
/// pixel after pixel with all bands of a pixel together.
enum class Interleave { bsq, bil, bip };
inline constexpr std::array<std::string_view, 3> interleave_names = {"bsq", "bil", "bip"};

/// What the header of an ENVI file says that matters here. The field names are those of the header.
struct EnviHeader {
    std::string source;  ///< names the header in messages
    std::uint64_t samples = 0;
    std::uint64_t lines = 0;
    std::uint64_t bands = 0;
    std::uint64_t header_offset = 0;  ///< bytes in the data file before the first number
    Interleave interleave = Interleave::bsq;
    NumberType data_type{};
    std::optional<double> reflectance_scale_factor;  ///< the number that stands for 1; above 0
    std::optional<double> data_ignore_value;         ///< stands for no measurement; NaN always does
    std::vector<double> wavelength_nm;               ///< one per band, finite, in any order; empty where not given
    std::vector<double> fwhm_nm;                     ///< one per band, not negative; empty where not given
    std::string wavelength_rule;                     ///< how the unit of the wavelengths was found, in words
    std::string sensor_type;                         ///< empty where not given
    std::vector<bool> good;                          ///< one per band: not marked as bad by `bbl`
    std::vector<std::string> band_names;             ///< one per band; empty where not given or not one per band
    /// `key = value`, without line ends, of what the header says about where on earth or in a larger picture the pixels
    /// lie: `map info`, `projection info`, `coordinate system string`, `geo points`, `pixel size`, `x start`, `y
    /// start`.
    std::vector<std::string> place;

    /// The bytes the data file must have at least; 2^64 - 1 where they are more.
    [[nodiscard]] std::uint64_t data_file_bytes() const;
};

/// True for text that begins as every ENVI header does: with the word ENVI on a line of its own.
[[nodiscard]] bool is_envi_header(std::string_view text);

/// Reads the header of an ENVI file (nv5geospatialsoftware.com/docs/enviheaderfiles.html).
///
/// The first line is ENVI; then `key = value`, or `key = {value, ...}` over any number of lines. Keys are read in any
/// case; lines that begin with a semicolon, keys not named above and lines without `=` are not read.
///
/// Unit of the wavelengths: `wavelength units` where it names nanometres or micrometres; where it is not given or
/// unknown, micrometres if no wavelength exceeds 10 and nanometres if some does.
///
/// Throws InputError, naming the line, for a key that is missing, given twice or malformed, lists that do not have one
/// number per band, data that are complex, compressed, with frame offsets, or a spectral library, and more than 2^31 -
/// 1 samples or lines or 65536 bands.
[[nodiscard]] EnviHeader parse_envi_header(std::string_view text, const std::string& source);

}  // namespace skinfit
