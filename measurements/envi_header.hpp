#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.hpp"
#include "measurements/number_type.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// The order of the numbers in a cube's data: band after band, line after line with all bands of a line together, or
/// pixel after pixel with all bands of a pixel together.
enum class Interleave { bsq, bil, bip };
inline constexpr std::array<std::string_view, 3> interleave_names = {"bsq", "bil", "bip"};

/// What a field of a header says of the quantity measured.
struct EnviStatement {
    std::size_t line;
    std::string key;
    std::string value;
    std::string word;  ///< of the value, that decided
    bool in_prose;     ///< in a description, not where the unit belongs
};

/// What the header of an ENVI file says that matters here. The field names are those of the header.
///
/// A spectral library, whose data have a spectrum in every line, is a cube of one pixel to a line: its `samples` are
/// the bands here.
struct EnviHeader {
    std::string source;  ///< names the header in messages
    std::uint64_t samples = 0;
    std::uint64_t lines = 0;
    std::uint64_t bands = 0;
    std::uint64_t header_offset = 0;  ///< bytes in the data file before the first number
    Interleave interleave = Interleave::bsq;
    NumberType data_type{};
    bool spectral_library = false;
    std::string file_type;             ///< in small letters; empty where not given
    std::vector<double> gain;          ///< one per band; empty where not given: 1
    std::vector<double> data_offset;   ///< one per band, added after the gain; empty where not given: 0
    std::optional<Quantity> quantity;  ///< where the header says so
    Geometry geometry;                 ///< as far as the header says so
    bool percent = false;              ///< the header calls the values percent
    /// Where the header says that the values are no shares of light: the field, and the word there.
    std::optional<EnviStatement> other_quantity;
    std::optional<double> reflectance_scale_factor;  ///< the number that stands for 1; above 0
    std::optional<double> data_ignore_value;         ///< stands for no measurement; NaN always does
    std::vector<double> wavelength_nm;               ///< one per band, finite, in any order; empty where not given
    std::vector<double> fwhm_nm;                     ///< one per band, not negative; empty where not given
    std::string wavelength_rule;                     ///< how the unit of the wavelengths was found, in words
    std::string sensor_type;                         ///< empty where not given
    std::vector<bool> good;                          ///< one per band: not marked as bad by `bbl`
    std::vector<std::string> band_names;             ///< one per band; empty where not given or not one per band
    std::vector<std::string> spectra_names;          ///< one per line of a library; empty where not given
    std::vector<std::string> remarks;                ///< on what the header states and is not used
    std::vector<FileDoubt> doubts;                   ///< on what contradicts the data, or may change them
    /// `key = value`, without line ends, of what the header says about where on earth or in a larger picture the pixels
    /// lie: `map info`, `projection info`, `coordinate system string`, `geo points`, `pixel size`, `x start`, `y
    /// start`.
    std::vector<std::string> place;

    /// The bytes the data file must have at least; 2^64 - 1 where they are more.
    [[nodiscard]] std::uint64_t data_file_bytes() const;
};

/// The text without the byte order mark of UTF-8 in front.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

/// True for text that begins as every ENVI header does: with the word ENVI on a line of its own, a byte order
/// mark apart.
[[nodiscard]] bool is_envi_header(std::string_view text);

/// Reads the header of an ENVI file (nv5geospatialsoftware.com/docs/enviheaderfiles.html).
///
/// The first line is ENVI; then `key = value`, or `key = {value, ...}` over any number of lines (`EnviFields`). Keys
/// not named above whose words are those of a conversion (scale, gain, offset, unit, ...) make a remark; others are
/// not read.
///
/// Unit of the wavelengths: `wavelength units`, a unit of length, of frequency or 1/cm, or behind each wavelength;
/// where it is not given or unknown, that in the first of the `z plot titles`, else micrometres if no wavelength
/// exceeds 10 and nanometres if some does.
///
/// Quantity and geometry: `z plot titles`, `data units` and their like, `product type` and `description`; where none of
/// them says anything, names of bands that differ in numbers alone.
///
/// Throws InputError, naming the line, for a key that is missing, given twice or malformed, lists that do not have one
/// number per band, wavelengths that are band numbers, data that are complex, compressed, with frame offsets, or in a
/// file of another form, and more than 2^31 - 1 samples or lines or 65536 bands.
[[nodiscard]] EnviHeader parse_envi_header(std::string_view text, const std::string& source);

}  // namespace skinfit
