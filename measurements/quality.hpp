#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// How much a finding matters.
enum class Severity : std::uint8_t {
    note,     ///< to be known; a fit of the spectrum is as good as without it
    warning,  ///< a fit of the spectrum cannot be trusted
};

/// Something about a spectrum that its user should know before it is fitted.
struct Finding {
    std::string name;  ///< of the check, as in `collapse_at_end`
    Severity severity = Severity::warning;
    std::string spectrum;  ///< its name
    std::string message;   ///< what was found, with the numbers that decided
    std::string remedy;    ///< what to do about it
};

/// The wavelengths that the model knows, nm.
struct ModelledRange {
    double lowest_nm;
    double highest_nm;
};

/// What the checks of `quality_checks.hpp` find in spectra that were measured as one set: those on single spectra in
/// the order of the set, then those that compare spectra; nothing of spectra without values.
[[nodiscard]] std::vector<Finding> quality_findings(std::span<const Spectrum> spectra, const ModelledRange& modelled);

/// The word for `severity` in tables and JSON.
[[nodiscard]] std::string_view name_of(Severity severity);

/// Throws InputError naming `source` where there are warnings, with the first of them and its remedy.
void refuse_warnings(const std::vector<Finding>& findings, const std::string& source);

}  // namespace skinfit
