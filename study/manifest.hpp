#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/cohort_simulation.hpp"

namespace skinfit {

/// The names of the tables beside each other in a cohort's folder.
inline constexpr std::string_view spectra_file = "spectra.csv";
inline constexpr std::string_view manifest_file = "manifest.csv";

/// The columns of the manifest: `file`, `spectrum`, `subject`, `repeat`, `group`, metadata, labels, and
/// `true_<parameter>` for every parameter that varies.
[[nodiscard]] std::vector<std::string> manifest_columns(const Cohort& cohort);

/// One line per spectrum: where it is, and what is true of it. Numbers read back to the last bit.
[[nodiscard]] std::string manifest_csv(const Cohort& cohort, const SimulatedCohort& simulated);

/// The spectra, one per row, fractions, under comments that describe the measurement; read by `read_spectra`, to the
/// last bit, under the names that the manifest gives them.
[[nodiscard]] std::string cohort_spectra_csv(const Cohort& cohort, const SimulatedCohort& simulated);

}  // namespace skinfit
