#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "measurements/cgats_table.hpp"
#include "measurements/spectrum.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/unit_rule.hpp"

namespace skinfit {

/// The fields of one spectrum of each set.
struct CgatsBands {
    std::string prefix;                            ///< of their names, in small letters, as `spec` or `sci`
    std::vector<std::size_t> field;                ///< at least one
    std::vector<double> wavelength_nm;             ///< one per field; empty where each set has its own
    std::vector<std::size_t> wavelength_field;     ///< one per field; empty but for pairs
    std::optional<Unit> unit{};                    ///< where the names state it
    std::optional<Quantity> quantity{};            ///< likewise
    std::optional<UncertaintyName> uncertainty{};  ///< where these are uncertainties of other fields
    std::vector<FileDoubt> doubts{};               ///< where keywords contradict the names
};

/// The spectra that the fields of a table make. Fields of one are called by a prefix and the wavelength in nm, as
/// `SPEC_360`, `NM_360`, `nm360`, `SPECTRAL_NM360`, `SPECTRAL_360`, `SPECTRUM_360`, `R_360`, `360_NM`, or come in pairs
/// of the wavelength and the value, `SPECTRAL_NM` with `SPECTRAL_PCT` (percent) or `SPECTRAL_DEC` (fraction). Fields
/// such as `STDEV_360` are uncertainties, and stand among the spectra.
///
/// Argyll rounds the names to whole nanometres; SPECTRAL_START_NM, SPECTRAL_END_NM and SPECTRAL_BANDS, where they agree
/// with them, are exact.
[[nodiscard]] std::vector<CgatsBands> cgats_bands(const CgatsTable& table);

}  // namespace skinfit
