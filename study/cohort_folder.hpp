#pragma once

#include <filesystem>

#include "study/cohort_simulation.hpp"

namespace skinfit {

/// Whether `folder` holds an earlier simulated cohort, which `write_cohort` would replace. Throws InputError where it
/// holds anything else, or where `source`, the cohort being read, is among its files.
[[nodiscard]] bool holds_earlier_cohort(const std::filesystem::path& folder, const std::filesystem::path& source);

/// Writes `spectra.csv`, `manifest.csv`, `cohort.json` (the resolved cohort) and `study.json` (for `skinfit study run`)
/// into `folder`, which exists; each of them whole or not at all.
void write_cohort(const Cohort& cohort, const SimulatedCohort& simulated, const std::filesystem::path& folder);

}  // namespace skinfit
