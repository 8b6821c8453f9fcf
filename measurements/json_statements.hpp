#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/file_statements.hpp"
#include "measurements/json_object.hpp"
#include "measurements/spectrum.hpp"

/// What an object of JSON states of its spectrum in names of its own choice.
namespace skinfit {

/// Names with a meaning; any other is a note.
inline constexpr std::array<std::string_view, 22> json_names = {
    "name",         "wavelength_nm", "start",          "step",
    "value",        "values",        "sigma",          "unit",
    "quantity",     "incidence_deg", "specular",       "viewing_cone_deg",
    "instrument",   "site",          "aperture_mm",    "repeats",
    "sigma_source", "missing_nm",    "bandpass_shape", "bandpass_width_nm",
    "notes",        "missing"};

/// `spectrum` with what stands beside the list of spectra in `file`, where it does not say otherwise, and with what
/// objects inside it, such as `metadata`, say of the measurement under the names above.
[[nodiscard]] Json completed(const Json& spectrum, const Json& file);

/// What the other names state, as comments of text files do, also those inside objects; of `notes` what the values are
/// and the specular state alone, since other statements have been applied by whoever wrote them. Throws InputError as
/// `statements_in`.
[[nodiscard]] FileStatements statements_in(const JsonObject& object);

/// The numbers that stand for missing values by names such as `fill_value` or `no_data`.
[[nodiscard]] std::vector<double> missing_values(const JsonObject& object);

/// Where names such as `npoints`, `count`, `end` or `lastx` contradict the numbers along the spectrum, as the file has
/// them.
[[nodiscard]] std::vector<FileDoubt> contradictions(const JsonObject& object, std::span<const double> x);

/// True for names that some of these read, with these values: they are no slips of the names above.
[[nodiscard]] bool is_understood(std::string_view name, const Json& value);

}  // namespace skinfit
