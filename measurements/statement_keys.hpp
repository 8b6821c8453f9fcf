#pragma once

#include <optional>
#include <string_view>

#include "measurements/abscissa.hpp"
#include "measurements/value_statement.hpp"

/// What the value of a key and what prose state of the values and the abscissa of a table.
namespace skinfit {

/// What the parts of a line between commas are: of prose each may state something; cells of a table speak of all values
/// only where all of them say the same.
enum class Clauses { of_prose, cells };

/// True for keys of the ordinate, as YUNITS, Mode, Measurement type or Quantity.
[[nodiscard]] bool is_ordinate_key(std::string_view key);

/// True for keys of the abscissa, as XUNITS.
[[nodiscard]] bool is_abscissa_key(std::string_view key);

/// What `value` states under `key`, or as the label of a row called `key`: any words, and letters, where the key is
/// that of the ordinate; else what holds nothing but the name of a quantity, or says what the values are of, and is not
/// said of a lamp, a reference or the like.
[[nodiscard]] ValueStatement values_stated_under(std::string_view key, std::string_view value,
                                                 Clauses clauses = Clauses::of_prose);

/// The same of the abscissa. Under other keys than its own a unit counts only where the key speaks of an axis.
[[nodiscard]] std::optional<Abscissa> abscissa_stated_under(std::string_view key, std::string_view value);

/// What a line of prose states: `Transmittance`, `Reflectance in percent`, `Spectrum file is raw data`, `Spectra of
/// skin as absorbance, measured in May`, `Absorbance spectrum of forearm`; nothing where its parts contradict each
/// other.
[[nodiscard]] ValueStatement values_stated_in_prose(std::string_view line, Clauses clauses = Clauses::of_prose);

/// The same of the abscissa, with its unit: `Frequency (THz)`, `x in THz, y in %`.
[[nodiscard]] std::optional<Abscissa> abscissa_stated_in_prose(std::string_view line);

}  // namespace skinfit
