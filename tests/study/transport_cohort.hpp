#pragma once

#include "tests/study/small_cohort.hpp"

namespace skinfit::test {

/// A cohort by transport of two groups, quickly simulated: few photons, three wavelengths, one epidermis.
[[nodiscard]] Json transport_cohort_json();

}  // namespace skinfit::test
