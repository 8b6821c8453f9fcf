#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.hpp"

namespace skinfit {

/// How a spectrum was measured, as far as its file says so.
struct Geometry {
    std::optional<double> incidence_deg{};  ///< to the normal, from 0 to 85
    std::optional<Specular> specular{};
    std::optional<double> viewing_cone_deg{};  ///< half angle about the normal, from 0.1 to 90
};

/// A comment `key: value` of a file that says nothing about the measurement; fit/file_settings.hpp reads some.
struct FileNote {
    std::size_t line;  ///< counted from 1
    std::string key;
    std::string value;
};

/// Something by which a file contradicts itself, so that the values may be wrong.
struct FileDoubt {
    std::string message;
    std::string remedy;
};

/// How an instrument weights the wavelengths about the one it reports.
enum class BandpassShape { triangular, gaussian, rectangular };
inline constexpr std::array<std::string_view, 3> bandpass_shape_names = {"triangular", "gaussian", "rectangular"};

/// The bandpass of an instrument, the same at every wavelength.
struct Bandpass {
    BandpassShape shape = BandpassShape::triangular;
    double width_nm = 0.0;  ///< full width at half maximum, above 0
};

/// A wavelength that a file gives more than once.
struct RepeatedWavelength {
    double wavelength_nm;
    std::string where;  ///< it stands again, as messages name the place
    std::string first;  ///< what has it already, as in "line 4"
};

/// A measured spectrum. Wavelengths, values and uncertainties go together: entry i of each belongs to one wavelength.
struct Spectrum {
    std::string name;                   ///< of the specimen: as its file says, else the column chosen, else the file
    std::string source;                 ///< the file it came from
    std::vector<double> wavelength_nm;  ///< at least one, in [100, 10000], ascends; may repeat
    std::vector<double> value;          ///< finite fractions, one per wavelength; `read_spectrum` checks their range
    std::vector<double> sigma;          ///< standard uncertainty of `value`, as given; empty where not given
    std::optional<Quantity> quantity;   ///< where the file says so
    Geometry geometry;
    std::string unit_rule;                       ///< how the unit of the values was found, in words
    std::vector<FileNote> notes{};               ///< in the order of the file
    std::string sigma_source{};                  ///< where `sigma` comes from, in words; empty where there is none
    std::vector<std::vector<double>> repeats{};  ///< readings of this specimen at these wavelengths, where known
    std::string instrument{};                    ///< as its file names it
    std::string site{};                          ///< of the body, as its file names it
    std::optional<double> aperture_mm{};         ///< diameter, above 0
    std::optional<Bandpass> bandpass{};
    std::vector<double> missing_nm{};            ///< wavelengths of the file without a value; they are left out above
    std::vector<RepeatedWavelength> repeated{};  ///< places of the first of the wavelengths above that come again
    std::vector<std::string> remarks{};  ///< what its reader left out, converted or could not make out, in words
    std::vector<FileDoubt> doubts{};     ///< in what its file contradicts itself
    std::string unusable{};  ///< why it is no spectrum that can be used; empty in all that `parse_spectra` returns
    std::size_t line = 0;    ///< where it stands in its file: its own line or the header, from 1; 0 where neither is
};

}  // namespace skinfit
