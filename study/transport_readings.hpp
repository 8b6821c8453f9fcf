#pragma once

#include "study/cohort_simulation.hpp"

namespace skinfit {

/// Fills in `SimulatedSubject::noise_free` of every subject of a cohort by transport, with its scale and offset. The
/// same bits on any number of threads. Throws Cancelled soon after `watch.stop` is requested.
void read_by_transport(const Cohort& cohort, SimulatedCohort& simulated, const SimulationWatch& watch);

}  // namespace skinfit
