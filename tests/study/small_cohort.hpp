#pragma once

#include "model/disk_cache.hpp"
#include "study/cohort_simulation.hpp"

namespace skinfit::test {

/// A cohort of two groups that is quickly simulated: three wavelengths, one prior of every kind, a label and metadata.
[[nodiscard]] Json small_cohort();

/// `json` read, as "cohort.json".
[[nodiscard]] Cohort cohort_of(const Json& json);

/// Keeps nothing and says nothing.
[[nodiscard]] DiskCache without_cache();

}  // namespace skinfit::test
