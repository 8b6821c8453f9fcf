#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "measurements/region_choice.hpp"
#include "measurements/spectrum.hpp"
#include "measurements/unit_rule.hpp"
#include "measurements/wavelength_window.hpp"

namespace skinfit {

/// What to take from a file, where the file leaves a choice.
struct ReadOptions {
    std::optional<std::string> column{};  ///< a column's name, else its number counted from 1 without the wavelengths
    std::optional<Unit> unit{};           ///< overrides what the file says
    RegionChoice region{};                ///< the pixels of a cube
    WavelengthWindow window{};            ///< what will be used: nothing else decides a unit or is a reason to refuse
};

/// How messages name one value of a spectrum.
struct ValuePlace {
    std::string where;
    std::string sigma = "sigma";  ///< the name of its uncertainty
};

/// Throws InputError where the uncertainty of reading `i`, if the spectrum has them, is missing or not above 0;
/// `place_of` tells where reading `i` stands.
void refuse_sigma(const Spectrum& spectrum, std::size_t i, const std::function<ValuePlace(std::size_t)>& place_of);

struct OpenedSpectra;

/// Throws InputError where the spectrum has two values at one wavelength.
void refuse_repeated(const Spectrum& spectrum);

/// Reads the one spectrum of a file, or the one that `options.column` names, in any form that `read_spectra` knows;
/// `reader` overrides the recognition of the form.
///
/// In columns, `split_columns` states the dialects, `plan_table` which column holds what, `read_numbers` where a comma
/// is a decimal mark; cells of columns that are not chosen are read for the unit alone. Comments `# key: value` with
/// the keys of `Description` describe the measurement, as in `measurements/data/`; `statements_in` says what other
/// lines state. What the name of a column states goes before that. Lines may come in any order.
///
/// Unit: `find_unit`. Missing values are left out and counted.
///
/// Throws InputError for a file that is missing, empty, binary, holds a word where a number is needed or a number that
/// is not finite, lacks a wavelength, has several spectra and none chosen, wavelengths outside [100, 10000] nm, or, in
/// `options.window`, repeats a wavelength or has values outside [0, 1.5] once they are fractions or uncertainties that
/// are not above 0.
[[nodiscard]] Spectrum read_spectrum(const std::filesystem::path& path, const ReadOptions& options = {},
                                     const std::optional<std::string>& reader = {});

/// The same of a file that is open already.
[[nodiscard]] Spectrum spectrum_in(const OpenedSpectra& opened, const ReadOptions& options);

/// The same for text already read; `source` names it in messages.
[[nodiscard]] Spectrum parse_spectrum(std::string_view text, const std::string& source, const ReadOptions& options = {},
                                      const std::optional<std::string>& reader = {});

}  // namespace skinfit
