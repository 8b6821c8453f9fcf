#pragma once

#include "app/progress_line.hpp"
#include "app/session.hpp"
#include "study/cohort_simulation.hpp"

namespace skinfit {

/// Shows on `line` how far the layered transport is with the wavelengths of `cohort`; Ctrl-C cancels it.
[[nodiscard]] SimulationWatch transport_watch(const Cohort& cohort, Session& session, ProgressLine& line);

}  // namespace skinfit
