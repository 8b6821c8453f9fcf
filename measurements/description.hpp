#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/columns.hpp"
#include "measurements/spectrum.hpp"
#include "measurements/unit_rule.hpp"

namespace skinfit {

/// What the comments of a file say about its measurement.
struct Description {
    std::optional<Quantity> quantity;  ///< `quantity: reflectance` or `transmittance`
    std::optional<Unit> unit;          ///< `unit: fraction` or `percent`
    /// `incidence_deg: 45`, `specular: included` or `excluded`, `viewing_cone_deg: 5`
    Geometry geometry;
    std::string specimen;                         ///< `specimen: any text`
    std::string site;                             ///< `site: any text`
    std::string instrument;                       ///< `instrument: any text`
    std::string sigma_source;                     ///< `sigma_source: any text`
    std::optional<double> aperture_mm;            ///< `aperture_mm: 3`
    std::optional<BandpassShape> bandpass_shape;  ///< `bandpass_shape: triangular`, `gaussian` or `rectangular`
    std::optional<double> bandpass_width_nm;      ///< `bandpass_width_nm: 10`, with the shape or not at all
    std::vector<FileNote> notes;                  ///< all other comments of the form `key: value`
};

/// Reads the comments of the form `key: value` with the keys above. Throws InputError for a key with a value that is
/// not one of its own, for a key given twice, and for a key that looks like a slip of one that changes what is read.
[[nodiscard]] Description read_description(const std::string& source, std::span<const Comment> comments);

/// Throws InputError where the key of a comment on `line` is a slip of one of `known` (not empty): in other letters,
/// cut short or misspelt. One of them itself is good.
void refuse_slip(const std::string& source, std::size_t line, std::string_view key,
                 std::span<const std::string_view> known);

/// The lines of prose of the form `key: value`, whatever their keys.
[[nodiscard]] std::vector<FileNote> notes_in(std::span<const Comment> prose);

/// A spectrum without numbers of which the file says this; the specimen is its name.
[[nodiscard]] Spectrum spectrum_of(const Description& description);

}  // namespace skinfit
