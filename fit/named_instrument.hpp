#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// What is known of a kind of instrument; what has no source is unset. Files of `configs/instruments/` give the
/// sources.
struct NamedInstrument {
    std::string name;  ///< or file, as the user or a measured file calls it
    std::string description;
    Geometry geometry{};
    std::optional<double> aperture_mm{};  ///< for the record: the model has no edges
    std::optional<Bandpass> bandpass{};
    std::optional<double> first_nm{};
    std::optional<double> last_nm{};
    std::optional<double> step_nm{};
    std::optional<double> noise{};  ///< standard uncertainty of a value, fraction
};

/// The names of the instruments that come with the program.
[[nodiscard]] std::vector<std::string> instrument_names();

/// The instrument of that name, else the one that the file, or pipe, of that name describes, which is opened once.
/// Throws InputError naming `where` where there is neither, and naming the file where it is malformed or states
/// something without its source.
[[nodiscard]] NamedInstrument find_instrument(const std::string& name_or_file, const std::string& where);

/// The same from text; `source` names it in messages, and the instrument.
[[nodiscard]] NamedInstrument parse_instrument(std::string_view text, const std::string& source);

}  // namespace skinfit
